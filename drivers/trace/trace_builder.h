#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "drivers/trace/read_options.h"
#include "drivers/trace/trace_row.h"
#include "runtime/error.h"
#include "runtime/gaze/gaze_trace.h"

namespace gazeloop::drivers {

/// Where a trace comes from, and what its device's clock counts.
struct TraceOrigin {
    std::string file;
    std::string_view format;
    std::string device;
    double device_tick_ns = 1.0;
};

/// Makes a trace from a file's rows and enforces what gaze_trace.h promises.
class TraceBuilder {
  public:
    explicit TraceBuilder(TraceOrigin origin);

    /// Takes the rows in the file's order. Drops and counts one without a time, or whose time is
    /// not later than that of the row before.
    void add(const TraceRow& row);

    [[nodiscard]] gaze::TraceReport& report() { return trace_.report; }

    /// The trace. Errors (BadInput): no row was added; none of them has a valid eye.
    [[nodiscard]] Expected<gaze::GazeTrace> finish(const ReadOptions& options);

  private:
    /// A reading of a clock as time since its first one, ns; none more than a year away.
    [[nodiscard]] static std::optional<std::int64_t> since_first_ns(
        std::optional<std::int64_t>& first, std::int64_t reading, double tick_ns);

    double tick_ns_;
    gaze::GazeTrace trace_;
    std::optional<std::int64_t> first_ticks_;
    std::optional<std::int64_t> first_host_ns_;
    std::optional<std::uint64_t> sequence_;  ///< of the row before, dropped or not
    bool any_valid_ = false;
};

}  // namespace gazeloop::drivers
