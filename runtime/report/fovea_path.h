#pragma once

#include <cstdint>
#include <string>

#include "runtime/error.h"
#include "runtime/latency/span_series.h"
#include "runtime/session/open_session.h"

namespace gazeloop::report {

/// How far apart the foveae of two sessions lie, frame by frame. A frame of one is held against the
/// frame of the same number in the other, if both were rendered for the same view: the same field
/// of view, and a view pose that differs by less than .01 degrees. Elsewhere a direction in the
/// view says nothing of the other's.
struct FoveaPathDifference {
    std::uint64_t compared = 0;      ///< frames, both eyes each
    std::uint64_t only_in_one = 0;   ///< frames of a number that the other lacks, or did not render
    std::uint64_t other_view = 0;    ///< frames whose views differ
    std::uint64_t without_gaze = 0;  ///< frames in which one of the two rests on no fresh sample
    /// Angle between the two, degrees, of the eye where it is larger. By the bins of
    /// latency::DurationHistogram: percentiles within .2 %. NaN where nothing was compared.
    double mean_deg = 0.0;
    double p50_deg = 0.0;
    double p95_deg = 0.0;
    double max_deg = 0.0;

    /// Why it says little or nothing; empty: at least half of the frames were compared.
    [[nodiscard]] std::string doubt() const;
};

/// Reads both once, in step, in memory that no length changes. Errors: those of reading a session.
Expected<FoveaPathDifference> fovea_path_difference(const session::OpenSession& before,
                                                    const session::OpenSession& after);

}  // namespace gazeloop::report
