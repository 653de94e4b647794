#include "tests/support/misses/widening_trial.h"

#include <glm/trigonometric.hpp>

#include "tests/support/misses/simulated_people.h"

namespace gazeloop::tests {
namespace {

gaze::FoveaPolicy policy_of(WideningRule rule, const sim::TrackerTerms& tracker) {
    gaze::FoveaPolicy policy;
    policy.motion.predict = rule != WideningRule::Held;
    if (rule == WideningRule::Held || rule == WideningRule::Predicted) {
        return policy;
    }
    policy.uncertainty = gaze::UncertaintyPolicy{.median_error_deg = tracker.bias_deg,
                                                 .noise_deg = tracker.noise_deg,
                                                 .by_events = rule != WideningRule::ByAge};
    if (rule == WideningRule::Suppressed) {
        constexpr double kMargin_s = 6e-3;
        policy.uncertainty->suppressed_before_landing_s = kMargin_s;
    }
    return policy;
}

}  // namespace

gaze::EyeView square_view(std::uint32_t side_px, double across_deg) {
    const double half_rad = glm::radians(0.5 * across_deg);
    return {.pose = {},
            .fov = {.left_rad = -half_rad,
                    .right_rad = half_rad,
                    .up_rad = half_rad,
                    .down_rad = -half_rad},
            .width_px = side_px,
            .height_px = side_px};
}

std::vector<ShownGaze> widening_trial(WideningRule rule, std::uint64_t first, std::uint64_t persons,
                                      const sim::TrackerTerms& tracker) {
    constexpr double kSeconds = 30.0;
    constexpr double kBetweenEyes_m = 0.063;
    Headset headset{.views = {square_view(2160, 100.0), square_view(2160, 100.0)}};
    headset.views[0].pose.position_m.x = -0.5 * kBetweenEyes_m;
    headset.views[1].pose.position_m.x = 0.5 * kBetweenEyes_m;
    std::vector<ShownGaze> all;
    for (std::uint64_t person = first; person < first + persons; ++person) {
        const std::vector<ShownGaze> shown = shown_gaze(simulated_person(person, tracker), headset,
                                                        policy_of(rule, tracker), kSeconds);
        all.insert(all.end(), shown.begin(), shown.end());
    }
    return all;
}

}  // namespace gazeloop::tests
