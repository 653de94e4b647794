#include "runtime/gaze/fovea_uncertainty.h"

#include <algorithm>
#include <glm/trigonometric.hpp>

#include "runtime/gaze/direction_covariance.h"
#include "runtime/gaze/event_widening.h"
#include "runtime/gaze/gaze_uncertainty.h"

namespace gazeloop::gaze {
namespace {

/// What the eye may have done since the sample, as far as it is no part of the sum.
double since_deg(const UncertaintyPolicy& policy, const KnownGaze& known, double age_s) {
    const bool held = known.state == FoveaState::Held;
    if (!policy.by_events || !known.motion) {
        return held ? policy.lost_deg_per_s * age_s : 0.0;
    }
    return held ? lost_widening_deg(age_s, policy.lost_deg_per_s)
                : event_widening_deg(*known.motion, age_s);
}

}  // namespace

double uncertainty_rad(const UncertaintyPolicy& policy, const KnownGaze& known) {
    const double greatest_rad = glm::radians(policy.greatest_deg);
    const bool lost_for_good =
        known.state == FoveaState::Ahead || known.state == FoveaState::Returning;
    if (lost_for_good || !known.age_ns) {
        return greatest_rad;
    }
    const double age_s = static_cast<double>(std::max<std::int64_t>(*known.age_ns, 0)) * 1e-9;
    const bool by_events = policy.by_events && known.motion;
    if (by_events && known.state != FoveaState::Held && policy.suppressed_before_landing_s &&
        shown_in_flight(*known.motion, age_s, *policy.suppressed_before_landing_s)) {
        return 0.0;
    }
    const PredictedGaze predicted =
        by_events ? PredictedGaze{} : known.predicted.value_or(PredictedGaze{});
    const double noise_deg =
        known.covariance ? glm::degrees(greatest_sd_rad(*known.covariance)) : policy.noise_deg;
    const auto deg = widening_deg({
        .bias95_deg = bias95_deg(policy.median_error_deg),
        .sample_sd_deg = noise_deg,
        .pursuit_deg_s =
            by_events && known.motion->event != EyeEvent::Pursuit ? 0.0 : policy.pursuit_deg_per_s,
        .latency_s = std::max(age_s - static_cast<double>(predicted.horizon_ns) * 1e-9, 0.0),
        .head_rate_deg_s = known.head_known ? 0.0 : policy.head_deg_per_s,
        .gaze_age_s = age_s,
    });
    if (!deg) {
        return greatest_rad;  // a covariance that is none
    }
    return std::min(glm::radians(*deg + since_deg(policy, known, age_s)) +
                        known.parallax_rad.value_or(0.0) + predicted.uncertainty_rad,
                    greatest_rad);
}

}  // namespace gazeloop::gaze
