#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "drivers/trace/clock/kept_row.h"
#include "drivers/trace/clock/row_clock.h"
#include "drivers/trace/clock/trace_row.h"
#include "runtime/memory/long_vector.h"
#include "runtime/memory/spool.h"

namespace gazeloop::drivers {

/// All rows of a file in its order: their clocks, and in a spool what becomes the samples.
class RowsRead {
  public:
    RowsRead();
    /// The same of rows that are there already.
    explicit RowsRead(std::span<const TraceRow> rows);

    void add(const TraceRow& row);
    /// Makes room for so many in all.
    void reserve(std::size_t rows) { clocks_.reserve(rows); }

    [[nodiscard]] std::size_t size() const { return clocks_.size(); }
    [[nodiscard]] bool empty() const { return clocks_.empty(); }
    [[nodiscard]] std::span<RowClock> clocks() { return clocks_; }
    [[nodiscard]] std::span<const RowClock> clocks() const { return clocks_; }
    [[nodiscard]] const RowClock& operator[](std::size_t row) const { return clocks_[row]; }

    /// What else a row holds, until the next but one call. Not from two threads at once.
    [[nodiscard]] const KeptRow& kept(std::size_t row) const { return reader_[row]; }

    /// What is left once the clocks are judged.
    [[nodiscard]] std::shared_ptr<const memory::Spool<KeptRow>> rows() const { return kept_; }

  private:
    memory::LongVector<RowClock> clocks_;
    std::shared_ptr<memory::Spool<KeptRow>> kept_;
    mutable memory::SpoolReader<KeptRow> reader_;
};

}  // namespace gazeloop::drivers
