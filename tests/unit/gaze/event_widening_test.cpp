#include "runtime/gaze/event_widening.h"

#include <gtest/gtest.h>

#include <limits>

#include "runtime/gaze/fovea_uncertainty.h"

namespace gazeloop::gaze {
namespace {

constexpr double kOdd[]{std::numeric_limits<double>::quiet_NaN(),
                        std::numeric_limits<double>::infinity(), -1.0, 1e300};

TEST(EventWidening, FollowsWhatTheEyesDo) {
    const double resting = event_widening_deg({.event = EyeEvent::Fixation}, 0.03);
    EXPECT_GT(resting, 0.0);
    EXPECT_LT(resting, 2.5);
    EXPECT_EQ(event_widening_deg({.event = EyeEvent::Fixation}, 0.0), 0.0)
        << "no saccade begins and lands in no time";
    EXPECT_GT(event_widening_deg({.event = EyeEvent::Fixation}, 0.06), resting);
    EXPECT_GT(event_widening_deg({.event = EyeEvent::Fixation, .departure = 3.0}, 0.03), resting)
        << "this may be a saccade";
    const double begun = event_widening_deg({.event = EyeEvent::Saccade, .since_s = 0.0}, 0.03);
    const double later = event_widening_deg({.event = EyeEvent::Saccade, .since_s = 0.03}, 0.03);
    EXPECT_GT(begun, later);
    EXPECT_GT(later, resting);
    EXPECT_GT(event_widening_deg({.event = EyeEvent::Lost}, 0.03), resting);
    EXPECT_GT(lost_widening_deg(0.3, 30.0), lost_widening_deg(0.1, 30.0));
}

TEST(EventWidening, IsFiniteWhateverIsSeen) {
    for (const double odd : kOdd) {
        for (const EyeEvent event : {EyeEvent::Fixation, EyeEvent::Saccade, EyeEvent::Lost}) {
            const SeenMotion seen{.event = event, .since_s = odd, .departure = odd};
            for (const double ahead_s : {0.03, odd}) {
                const double deg = event_widening_deg(seen, ahead_s);
                EXPECT_GE(deg, 0.0);
                EXPECT_LE(deg, 20.0);
            }
        }
        EXPECT_FALSE(shown_in_flight({.event = EyeEvent::Saccade, .flies_on_s = -1.0}, odd, odd));
    }
}

TEST(EventWidening, KnowsWhichFramesAreShownInFlight) {
    const SeenMotion flying{.event = EyeEvent::Saccade, .flies_on_s = 0.04};
    EXPECT_TRUE(shown_in_flight(flying, 0.02, 0.006));
    EXPECT_FALSE(shown_in_flight(flying, 0.035, 0.006)) << "restored before it lands";
    EXPECT_FALSE(shown_in_flight({.event = EyeEvent::Fixation, .flies_on_s = 0.04}, 0.02, 0.006));
}

TEST(FoveaUncertainty, TakesEventsInPlaceOfAgeWhereAsked) {
    const UncertaintyPolicy by_events{.median_error_deg = 0.5,
                                      .noise_deg = 0.25,
                                      .by_events = true,
                                      .suppressed_before_landing_s = 0.006};
    constexpr double kDeg = 0.017453292519943295;
    KnownGaze known{.state = FoveaState::Tracking, .head_known = true, .age_ns = 30'000'000};
    known.motion = SeenMotion{.event = EyeEvent::Fixation};
    const double resting = uncertainty_rad(by_events, known) / kDeg;
    EXPECT_NEAR(resting, 1.3 + 0.49 + event_widening_deg(*known.motion, 0.03), 1e-9);
    known.predicted = {.uncertainty_rad = 1.0, .horizon_ns = 30'000'000};
    EXPECT_NEAR(uncertainty_rad(by_events, known) / kDeg, resting, 1e-9);
    known.motion = SeenMotion{.event = EyeEvent::Saccade, .flies_on_s = 0.05};
    EXPECT_EQ(uncertainty_rad(by_events, known), 0.0);
    known.motion->flies_on_s = 0.03;
    EXPECT_GT(uncertainty_rad(by_events, known) / kDeg, resting);
    known.state = FoveaState::Held;
    known.motion = SeenMotion{};
    EXPECT_NEAR(uncertainty_rad(by_events, known) / kDeg, 1.79 + lost_widening_deg(0.03, 30.0),
                0.31);
}

}  // namespace
}  // namespace gazeloop::gaze
