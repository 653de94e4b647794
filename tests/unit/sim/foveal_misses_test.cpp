// Whether the true gaze lies where the fovea is sharp: simulated people on whom nothing was chosen.
#include <gtest/gtest.h>

#include "tests/support/misses/sharp_region.h"
#include "tests/support/misses/simulated_people.h"
#include "tests/support/misses/widening_trial.h"

namespace gazeloop::tests {
namespace {

constexpr std::uint64_t kPersons = 6;

/// 60 px per degree: the display never hides that gaze is off, and widening is dear.
const SharpRegion& dense() {
    static const SharpRegion kDense(square_view(8192, 100.0));
    return kDense;
}

std::vector<ShownGaze> others(WideningRule rule) {
    return widening_trial(rule, kFirstOther, kPersons, kGenericTracker);
}

/// Of six persons the share varies by a third of a percent; `./dev bench misses` has more of them.
TEST(FovealMisses, AreFewForFewerSamplesThanWideningAllFrames) {
    const std::vector<ShownGaze> by_events = others(WideningRule::ByEvents);
    ASSERT_GT(by_events.size(), 25'000U);
    EXPECT_LT(misses_percent(by_events, dense(), Counted::Seen), 1.5);
    const std::vector<ShownGaze> predicted = others(WideningRule::Predicted);
    EXPECT_GT(misses_percent(predicted, dense(), Counted::Seen), 10.0) << "else nothing is shown";
    const double constant_deg = constant_widening_deg(
        predicted, dense(), Counted::Seen, misses_percent(by_events, dense(), Counted::Seen));
    EXPECT_LT(mean_samples(by_events, dense()), 0.8 * dense().samples(constant_deg));
    const std::vector<ShownGaze> by_age = others(WideningRule::ByAge);
    EXPECT_LT(mean_samples(by_events, dense()), 0.8 * mean_samples(by_age, dense()));
    EXPECT_LT(misses_percent(by_events, dense(), Counted::Seen),
              misses_percent(by_age, dense(), Counted::Seen));
}

TEST(FovealMisses, AreHardlyMoreWhereSuppressedFramesAreNotWidened) {
    // A tracker of 1 kHz without delay: else hardly a saccade outlasts what it is seen too late.
    constexpr sim::TrackerTerms kQuick{
        .rate_hz = 1000.0, .delay_ms = 1.0, .bias_deg = 0.4, .noise_deg = 0.05};
    const std::vector<ShownGaze> widened =
        widening_trial(WideningRule::ByEvents, kFirstOther, kPersons, kQuick);
    const std::vector<ShownGaze> suppressed =
        widening_trial(WideningRule::Suppressed, kFirstOther, kPersons, kQuick);
    ASSERT_EQ(suppressed.size(), widened.size());
    std::size_t plain = 0;
    std::size_t in_flight = 0;
    for (std::size_t i = 0; i < widened.size(); ++i) {
        if (suppressed[i].widening_deg != widened[i].widening_deg) {
            EXPECT_EQ(suppressed[i].widening_deg, 0.0);
            ++plain;
            in_flight += widened[i].in_flight ? 1U : 0U;
        }
    }
    EXPECT_GT(plain, 50U);
    EXPECT_GT(in_flight, plain / 2) << "most others are microsaccades";
    EXPECT_LT(misses_percent(suppressed, dense(), Counted::Seen),
              misses_percent(widened, dense(), Counted::Seen) + 0.1);
    EXPECT_LT(mean_samples(suppressed, dense()), mean_samples(widened, dense()));
}

}  // namespace
}  // namespace gazeloop::tests
