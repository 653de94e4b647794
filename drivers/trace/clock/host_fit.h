#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drivers/trace/clock/device_times.h"
#include "runtime/gaze/trace_report.h"
#include "runtime/memory/long_vector.h"

namespace gazeloop::drivers {

/// The device's times on a time line that runs at the rate of the host's clock. The vectors of
/// times are as long as those they are made of.
struct HostFit {
    memory::LongVector<std::int64_t> time_ns;  ///< since the first row; increases strictly
    /// How much longer than the quickest a report took to the host, >= 0; none where its host time
    /// is unknown or an outlier.
    memory::LongVector<std::optional<std::int64_t>> delay_ns;
    double skew_ppm = 0.0;       ///< by which the device's second is too short
    std::int64_t within_ns = 0;  ///< uncertainty of the line
    std::uint64_t steps = 0;     ///< of either clock
    std::uint64_t outliers = 0;  ///< host times that are left out
    /// How much faster the host's clock goes; other than 1 only where no two crystals differ so.
    double host_per_device = 1.0;
    bool absurd_rates = false;  ///< about twice as fast, or half, or worse: one unit must be wrong
    std::vector<gaze::TraceFinding> findings;
    /// One line for the report: "fitted to the host's clock: +148 ppm, within 0.02 ms, 1 step".
    std::string text;
};

/// Ties the device's clock to the host's as a live tracker's is tied, by offset and skew below the
/// arrivals (time::ClockFit), anew after each step of either clock. `host_ns` has each row's
/// arrival, `lines` its line in the file.
///
/// Where the device's clock was set, times go on by the host's; where the host's was set or slept,
/// by the device's (HostClockSet; lag_steps.h). Which host times count is host_times.h's, the line
/// of a stretch lag_line.h's, between whose knots the offset is interpolated. A skew that is less
/// than the uncertainty of the line, from end to end, is taken for none: times are then the
/// device's, unchanged.
///
/// Without two host times all times are the device's. So they are, without delays, where the rates
/// differ by more than 1000 ppm (ClockRates), or, in less than 8 s, by so much that the way to the
/// host cannot have made it; or where a tenth of the reports would have taken half a second or more
/// (HostClockSet). O(n log n).
[[nodiscard]] HostFit fit_to_host(const DeviceTimes& device,
                                  std::span<const std::optional<std::int64_t>> host_ns,
                                  std::span<const std::uint64_t> lines);

}  // namespace gazeloop::drivers
