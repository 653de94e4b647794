#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "drivers/trace/clock/row_clock.h"
#include "drivers/trace/clock/trace_row.h"
#include "runtime/gaze/gaze_sample.h"

namespace gazeloop::drivers {

/// All rows of a file in its order: their clocks, and beside them what becomes the samples, so that
/// no row is held twice. Each takes sizeof(RowClock) + sizeof(GazeSample) bytes.
class RowsRead {
  public:
    RowsRead() = default;
    /// The same of rows that are there already.
    explicit RowsRead(std::span<const TraceRow> rows);

    void add(const TraceRow& row);
    /// Makes room for so many in all.
    void reserve(std::size_t rows);

    [[nodiscard]] std::size_t size() const { return clocks_.size(); }
    [[nodiscard]] bool empty() const { return clocks_.empty(); }
    [[nodiscard]] std::span<RowClock> clocks() { return clocks_; }
    [[nodiscard]] std::span<const RowClock> clocks() const { return clocks_; }
    [[nodiscard]] const RowClock& operator[](std::size_t row) const { return clocks_[row]; }
    [[nodiscard]] const gaze::PerEye<gaze::EyeRay>& eyes(std::size_t row) const {
        return samples_[row].eyes;
    }

    /// The samples of these rows, no row twice, in this order, times and numbers not filled in yet.
    /// Leaves nothing behind.
    [[nodiscard]] std::vector<gaze::GazeSample> take(std::span<const std::size_t> rows);

  private:
    std::vector<RowClock> clocks_;
    std::vector<gaze::GazeSample> samples_;
};

}  // namespace gazeloop::drivers
