#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/gaze/gaze_sample.h"
#include "runtime/gaze/sample_range.h"
#include "runtime/gaze/trace_report.h"

namespace gazeloop::gaze {

/// Where recorded head poses go on from another origin (a recentre, or tracking that was lost and
/// began anew elsewhere).
struct NewOrigin {
    std::size_t sample = 0;        ///< the first one whose pose is given in the new world
    std::int64_t time_ns = 0;      ///< its
    std::int64_t interval_ns = 0;  ///< since the pose before it, as recorded
    double turned_rad = 0.0;       ///< from that pose
    double moved_m = 0.0;          ///< from that pose
    /// The new world's origin in the one before, if the head stood still between these two poses:
    /// a head that moves leaves the new world off by what it moved in one interval, which nobody
    /// can see.
    Pose new_in_old;
};

/// The places where a recorded head jumps as no head moves (head_limits.h) between two samples with
/// poses. A pose that is not usable, or whose time lies before that of the last one, is passed over
/// (TraceSource does the same). A pose's time is its sample's, or where that is unknown its
/// arrival's.
///
/// Times may be coarse, so that a jump and a plain turn both happen in no time. So the time between
/// two poses is taken for no less than
///   - the median interval of successive samples that is not 0: the trace's own interval, or the
///     step of its clock where that is longer, and
///   - the lower quartile of the intervals in which the pose changed, of those below 50 ms:
///   trackers
///     of 1000 Hz repeat each pose of a head that is followed at 90 Hz, and it then moves for 11 ms
///     in one of 1 ms. No headset gives fewer than 20 poses a second; longer intervals are heads
///     that rest.
[[nodiscard]] std::vector<NewOrigin> new_origins(const SampleRange& samples);

/// Adds a finding for each of them.
void report_new_origins(const SampleRange& samples, TraceReport& report);

}  // namespace gazeloop::gaze
