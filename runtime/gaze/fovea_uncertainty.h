#pragma once

#include <cstdint>
#include <optional>

#include "runtime/gaze/events/seen_motion.h"
#include "runtime/gaze/fovea_point.h"
#include "runtime/gaze/gaze_sample.h"

namespace gazeloop::gaze {

/// What is known of tracker, eye and head apart from the samples. Degrees, per second.
struct UncertaintyPolicy {
    double median_error_deg = 0.5;  ///< of the tracker: systematic
    double noise_deg = 0.2;         ///< SD, where a sample states no covariance
    double pursuit_deg_per_s = 10.0;
    double head_deg_per_s = 40.0;  ///< where no head pose is known
    double lost_deg_per_s = 30.0;  ///< while gaze is lost
    double greatest_deg = 20.0;    ///< of what comes out
    /// Widen by what the eyes are seen to do (gaze/event_widening.h), not by age alone.
    bool by_events = false;
    /// Then also: a frame that will be shown in the midst of a saccade, and so long before its
    /// landing, is not widened. None: such frames are widened as others.
    std::optional<double> suppressed_before_landing_s{};
};

/// How sure a prediction of the gaze is (gaze/events/gaze_predictor.h).
struct PredictedGaze {
    double uncertainty_rad = 0.0;
    std::int64_t horizon_ns = 0;  ///< so far ahead of the sample
};

/// What is known of one eye's gaze in one frame.
struct KnownGaze {
    FoveaState state = FoveaState::Ahead;
    std::optional<DirectionCovariance> covariance{};
    std::optional<double> parallax_rad{};
    bool head_known = false;
    /// From the sample to the frame's display, and by how much a filter makes the sample older.
    std::optional<std::int64_t> age_ns{};
    std::optional<PredictedGaze> predicted{};
    /// With UncertaintyPolicy::by_events; none: nothing is seen of how the eyes move.
    std::optional<SeenMotion> motion{};
};

/// How far from the fovea the eye may look when the frame is shown, radians: by widening_deg
/// (gaze/gaze_uncertainty.h), with the age in place of the latency, and the parallax of a ray that
/// is shared by both eyes on top. Of predicted gaze, the prediction's own uncertainty stands in
/// place of the latency that it covers. It includes the noise of a resting eye, which so counts
/// twice. Without a prediction, an unfinished saccade is not part of it. While gaze is held, it
/// grows with its age; of gaze that is lost for good, or of unknown age, nothing is known, which is
/// the greatest. In 0 .. greatest_deg.
///
/// With a motion, what the eyes may have done since counts by that in place of the age, the
/// prediction and, but in pursuit, the speed of pursuit; 0 of a suppressed frame.
[[nodiscard]] double uncertainty_rad(const UncertaintyPolicy& policy, const KnownGaze& known);

}  // namespace gazeloop::gaze
