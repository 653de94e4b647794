#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "runtime/gaze/trace_report.h"
#include "runtime/memory/long_vector.h"

namespace gazeloop::drivers {

/// A reading of the device's clock, and what the host's read.
struct TimedRow {
    std::uint64_t line = 0;
    /// From the row before, ns, >= 0; of the first row 0. `set` is whether that is a guess, because
    /// the clock was set in between.
    std::int64_t step_ns = 0;
    bool set = false;
    std::optional<std::int64_t> host_ns;
};

/// Rows that share a time, apart. As long as the rows it is made of.
struct SpreadTimes {
    memory::LongVector<std::int64_t> step_ns;    ///< from the row before
    memory::LongVector<std::int64_t> coarse_ns;  ///< as DeviceTimes::step_ns
    memory::LongVector<bool> reckoned;
    memory::LongVector<std::size_t> sets;  ///< where the clock goes on as if it had never stood
    std::int64_t interval_ns = 0;          ///< the usual one from row to row; 0: a single row
    std::vector<gaze::TraceFinding> findings;
};

/// Tells rows that share a time apart. As many as usually share one, up to four times that, are of
/// a clock that counts in steps: they are spread evenly over its step (`tick_ns`, or less if the
/// next reading comes sooner), in their order; those of the first and last step, which was not
/// seen from end to end, at the usual interval. More of them, 8 at least, are of a clock that
/// stood. If its next reading has caught up, they are spread up to that. Else they follow the
/// host's clock (stood_times.h), or the usual interval, and so does the next reading. `tick_ns` is
/// the usual step between readings that differ; 0 if none do.
[[nodiscard]] SpreadTimes spread(std::span<const TimedRow> rows, std::int64_t tick_ns);

}  // namespace gazeloop::drivers
