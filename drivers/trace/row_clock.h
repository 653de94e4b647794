#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "drivers/trace/csv_table.h"

namespace gazeloop::drivers {

/// A column of clock readings, read as time since the first one. An absolute time in nanoseconds
/// need not fit 64 bits (the Vive's clock counts from the year 1).
class RowClock {
  public:
    RowClock(std::size_t column, std::int64_t ns_per_unit)
        : column_(column), ns_per_unit_(ns_per_unit) {}

    /// The current row's time, ns. Refuses a reading more than a year from the first one: no
    /// recording is that long, and sums with these times must not overflow.
    [[nodiscard]] std::int64_t since_first_ns(CsvTable& table);

  private:
    std::size_t column_;
    std::int64_t ns_per_unit_;
    std::optional<std::int64_t> first_;
};

}  // namespace gazeloop::drivers
