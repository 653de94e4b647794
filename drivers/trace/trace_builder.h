#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "drivers/trace/built_trace.h"
#include "drivers/trace/clock/device_times.h"
#include "drivers/trace/clock/rows_read.h"
#include "drivers/trace/read_options.h"
#include "runtime/error.h"
#include "runtime/gaze/trace_report.h"

namespace gazeloop::drivers {

/// Where a trace comes from.
struct TraceOrigin {
    std::string file;         ///< as messages name it
    std::string_view format;  ///< as GazeTrace::format has it
    std::string device;
    double device_tick_ns = 1.0;        ///< > 0; a tick of TraceRow::device_ticks
    double other_tick_ns = 1.0;         ///< > 0; a tick of TraceRow::other_ticks
    std::string_view other_clock = {};  ///< as messages name it
};

/// Rows without any gaze because their cells are not understood.
struct NotUnderstood {
    std::uint64_t rows = 0;
    std::uint64_t first_line = 0;
};

/// Makes a trace from a file's rows and enforces what gaze_trace.h promises. Rows are held
/// until finish().
///
/// Clocks, order and sequence are judged over the whole trace, with both neighbours of a row at
/// hand (device_times.h, host_fit.h, sequence_numbers.h).
class TraceBuilder {
  public:
    explicit TraceBuilder(TraceOrigin origin);

    /// Takes the next row of the file, and counts it in report().rows.
    void add(const TraceRow& row);
    /// Makes room for so many rows in all, where that is known or guessed.
    void expect(std::size_t rows) { rows_.reserve(rows); }

    /// Says what the first row without device_ticks has in their place: "column 't': 'x' is no
    /// whole number of nanoseconds".
    void unread_time(std::string what) {
        unread_time_ = unread_time_.empty() ? std::move(what) : unread_time_;
    }
    [[nodiscard]] bool knows_unread_time() const { return !unread_time_.empty(); }

    /// Says what messages call the device's clock, "t_device_ns", and what its numbers count, ns.
    void clock_is(std::string name, double unit_ns) {
        clock_ = std::move(name);
        clock_unit_ns_ = unit_ns;
    }
    [[nodiscard]] bool knows_clock() const { return !clock_.empty(); }
    [[nodiscard]] const TraceOrigin& origin() const { return origin_; }
    /// Of all rows so far, in their order.
    [[nodiscard]] std::span<RowClock> clocks() { return rows_.clocks(); }

    /// For what the format's reader finds. Rows that it does not add it counts itself.
    [[nodiscard]] gaze::TraceReport& report() { return report_; }

    /// The trace. Once. Errors (BadInput), with file and line: no row was added;
    /// none has a readable time, or all have the same; no used row has a valid eye; it is longer
    /// than a year. Unless options.accept_repairs also: more than a tenth of the rows is dropped,
    /// or has no gaze because its cells are not understood (16 rows or more), or a clock was set at
    /// more than a tenth of them; a gap is longer than all the rest.
    [[nodiscard]] Expected<BuiltTrace> finish(const ReadOptions& options);

  private:
    /// Takes the other clock where the device's cannot be read in any row, or says the same in all.
    /// The tick, ns.
    [[nodiscard]] double choose_clock();
    /// Doubts a rate that no eye tracker has.
    void doubt_rate(const DeviceTimes& times, std::size_t samples, gaze::TraceReport& report) const;

    TraceOrigin origin_;
    std::string unread_time_;
    std::string clock_;
    double clock_unit_ns_ = 0.0;
    gaze::TraceReport report_;
    RowsRead rows_;
    NotUnderstood not_understood_;
};

}  // namespace gazeloop::drivers
