#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "drivers/trace/clock/clock_pair.h"
#include "runtime/gaze/trace_report.h"
#include "runtime/memory/long_vector.h"

namespace gazeloop::drivers {

/// The rows whose host time is worth something, ascending, and what was found of the others.
struct HostTimes {
    memory::LongVector<std::size_t> rows;
    bool stood = false;          ///< the host's clock, somewhere
    std::uint64_t outliers = 0;  ///< host times that neither neighbour agrees with
    std::vector<gaze::TraceFinding> findings;
};

/// Leaves out host times of a clock that stood while the device's went on, but for the first
/// (ClockStoodStill), and those that neither neighbour agrees with (HostTimeOutlier). `lines` has
/// each row's line in the file. O(n).
[[nodiscard]] HostTimes host_times(const ClockPair& clocks, std::span<const std::uint64_t> lines);

}  // namespace gazeloop::drivers
