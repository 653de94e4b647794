#include "runtime/gaze/events/event_detector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>
#include <random>
#include <vector>

#include "runtime/gaze/main_sequence.h"

namespace gazeloop::gaze {
namespace {

glm::dvec3 right_by(double deg) {
    return {std::sin(glm::radians(deg)), 0.0, -std::cos(glm::radians(deg))};
}

struct Told {
    double time_s = 0.0;
    EyeEvent event = EyeEvent::Lost;
};

/// Azimuths over time at some rate; what the detector tells of each sample, once it is told.
class Played {
  public:
    explicit Played(double rate_hz, double noise_deg = 0.0)
        : interval_s_(1.0 / rate_hz), noise_deg_(noise_deg) {}

    void rest(double seconds, double deg_per_s = 0.0) {
        for (const double end_s = now_s_ + seconds; now_s_ < end_s;) {
            deg_ += deg_per_s * interval_s_;
            look();
        }
    }
    void saccade(double amplitude_deg) {
        const SaccadeCourse course(std::abs(amplitude_deg), 1.0);
        const double from_deg = deg_;
        saccade_begin_s = now_s_;
        for (double t = interval_s_; t < course.duration_s() + interval_s_; t += interval_s_) {
            deg_ = from_deg + amplitude_deg * course.progress(t);
            look();
        }
        saccade_end_s = saccade_begin_s + course.duration_s();
    }
    void lose(double seconds) {
        for (const double end_s = now_s_ + seconds; now_s_ < end_s;) {
            step(std::nullopt);
        }
    }
    void look() {
        const double noise_deg = noise_deg_ > 0.0 ? noise_deg_ * normal_(engine_) : 0.0;
        step(right_by(deg_ + noise_deg));
    }
    void step(const std::optional<glm::dvec3>& direction) {
        const double before_s = now_s_;
        now_s_ += interval_s_;
        detector.add(std::llround(now_s_ * 1e9), direction);
        if (detector.event_before()) {
            told.push_back({before_s, *detector.event_before()});
        }
    }

    /// Share of the samples in a span that were told to be so.
    [[nodiscard]] double share(EyeEvent event, double from_s, double to_s) const {
        double all = 0.0;
        double such = 0.0;
        for (const Told& one : told) {
            if (one.time_s >= from_s && one.time_s <= to_s) {
                all += 1.0;
                such += one.event == event ? 1.0 : 0.0;
            }
        }
        return such / all;
    }
    [[nodiscard]] double now_s() const { return now_s_; }

    EventDetector detector;
    std::vector<Told> told;
    double saccade_begin_s = 0.0;
    double saccade_end_s = 0.0;

  private:
    double interval_s_;
    double noise_deg_;
    double now_s_ = 0.0;
    double deg_ = 0.0;
    std::mt19937 engine_{20171};
    std::normal_distribution<double> normal_;
};

const std::vector<double> kRates_hz{30.0, 60.0, 90.0, 120.0, 250.0, 500.0, 1000.0};

TEST(EventDetector, TellsFixationSaccadeAndFixationAtEveryRate) {
    for (const double rate_hz : kRates_hz) {
        SCOPED_TRACE(rate_hz);
        Played played(rate_hz, 0.02);
        played.rest(1.0);
        played.saccade(10.0);
        played.rest(0.6);
        EXPECT_EQ(played.share(EyeEvent::Saccade, 0.0, played.saccade_begin_s - 1.0 / rate_hz),
                  0.0);
        EXPECT_GT(played.share(EyeEvent::Fixation, 0.2, played.saccade_begin_s - 1.0 / rate_hz),
                  0.99);
        const double middle_s = 0.5 * (played.saccade_begin_s + played.saccade_end_s);
        EXPECT_GT(
            played.share(EyeEvent::Saccade, middle_s - 0.6 / rate_hz, middle_s + 0.6 / rate_hz),
            0.99);
        EXPECT_GT(played.share(EyeEvent::Fixation, played.saccade_end_s + 0.12, played.now_s()),
                  0.99);
    }
}

TEST(EventDetector, FindsTheEdgesOfASaccadeToTwoSamples) {
    Played played(500.0, 0.01);
    played.rest(0.5);
    played.saccade(8.0);
    played.rest(0.3);
    const auto is_saccade = [](const Told& one) { return one.event == EyeEvent::Saccade; };
    const auto first = std::ranges::find_if(played.told, is_saccade);
    ASSERT_NE(first, played.told.end());
    const auto after = std::find_if_not(first, played.told.end(), is_saccade);
    EXPECT_NEAR(first->time_s, played.saccade_begin_s + 0.004, 0.0045);
    EXPECT_NEAR(after->time_s, played.saccade_end_s, 0.0065);
}

TEST(EventDetector, TellsPursuitFromFixationAtEveryRate) {
    for (const double rate_hz : kRates_hz) {
        SCOPED_TRACE(rate_hz);
        Played played(rate_hz, 0.02);
        played.rest(1.0);
        const double begin_s = played.now_s();
        played.rest(2.0, 12.0);
        const double end_s = played.now_s();
        played.rest(1.5);
        EXPECT_GT(played.share(EyeEvent::Pursuit, begin_s + 0.5, end_s), 0.99);
        EXPECT_GT(played.share(EyeEvent::Fixation, end_s + 0.6, played.now_s()), 0.99);
        EXPECT_EQ(played.share(EyeEvent::Saccade, 0.0, played.now_s()), 0.0);
    }
}

TEST(EventDetector, KnowsTheVelocityOfWhatIsFollowed) {
    Played played(250.0);
    played.rest(1.0, 12.0);
    EXPECT_NEAR(glm::length(played.detector.slow_velocity_deg_per_s()), 12.0, 0.1);
    EXPECT_NEAR(glm::length(played.detector.velocity_deg_per_s()), 12.0, 0.1);
}

TEST(EventDetector, FindsASaccadeOutOfPursuitByItsDeparture) {
    Played played(500.0, 0.01);
    played.rest(1.0, 25.0);
    played.saccade(3.0);
    EXPECT_EQ(played.share(EyeEvent::Saccade, 0.0, played.saccade_begin_s - 0.002), 0.0);
    const double middle_s = 0.5 * (played.saccade_begin_s + played.saccade_end_s);
    EXPECT_EQ(played.share(EyeEvent::Saccade, middle_s - 0.004, middle_s + 0.004), 1.0);
}

TEST(EventDetector, FollowsTheNoise) {
    Played noisy(500.0, 0.2);
    noisy.rest(5.0);
    EXPECT_LT(noisy.share(EyeEvent::Saccade, 1.0, 5.0), 0.02);
    EXPECT_GT(noisy.detector.resting_deg_per_s(), 20.0);
    Played still(500.0, 0.002);
    still.rest(5.0);
    EXPECT_LT(still.detector.resting_deg_per_s(), 2.0);
}

TEST(EventDetector, TellsOscillationAfterASaccade) {
    Played played(500.0);
    played.rest(0.5);
    played.saccade(10.0);
    const double end_s = played.now_s();
    // Swings back by .6 deg and forth again.
    for (int i = 1; i <= 10; ++i) {
        played.step(right_by(10.0 - 0.6 * std::sin(i * 0.314)));
    }
    played.rest(0.3);
    EXPECT_GT(played.share(EyeEvent::Oscillation, end_s + 0.002, end_s + 0.018), 0.7);
    EXPECT_EQ(played.share(EyeEvent::Oscillation, end_s + 0.05, played.now_s()), 0.0);
}

TEST(EventDetector, LosesAndFindsTheGaze) {
    Played played(250.0, 0.01);
    played.rest(0.5);
    const double begin_s = played.now_s();
    played.lose(0.15);
    const double end_s = played.now_s();
    played.rest(0.3);
    EXPECT_EQ(played.share(EyeEvent::Lost, 0.0, begin_s), 0.0);
    EXPECT_EQ(played.share(EyeEvent::Lost, begin_s + 0.001, end_s), 1.0);
    EXPECT_EQ(played.share(EyeEvent::Fixation, end_s + 0.05, played.now_s()), 1.0);
    EXPECT_TRUE(played.detector.event() == EyeEvent::Fixation);
}

TEST(EventDetector, TakesAGapForALoss) {
    EventDetector detector;
    for (int i = 0; i < 100; ++i) {
        detector.add(i * 10'000'000LL, right_by(0.0));
    }
    EXPECT_EQ(detector.event(), EyeEvent::Fixation);
    detector.add(99 * 10'000'000LL + 51'000'000, right_by(5.0));
    EXPECT_EQ(detector.event(), EyeEvent::Lost);
    EXPECT_EQ(detector.event_before(), EyeEvent::Fixation);
    EXPECT_EQ(detector.history().size(), 1U);
}

TEST(EventDetector, CallsWhatNoEyeDoesLost) {
    Played played(500.0);
    played.rest(0.5);
    played.step(right_by(20.0));  // 10,000 deg/s
    played.step(right_by(20.0));
    played.step(right_by(20.0));
    EXPECT_EQ(played.detector.event(), EyeEvent::Lost);
}

TEST(EventDetector, LeavesOutRepeatedAndEarlierTimes) {
    Played played(500.0, 0.01);
    played.rest(0.5);
    const EventDetector before = played.detector;
    played.detector.add(std::llround(played.now_s() * 1e9), right_by(40.0));
    played.detector.add(0, right_by(40.0));
    played.detector.add(std::numeric_limits<std::int64_t>::min(), std::nullopt);
    EXPECT_EQ(played.detector.event(), before.event());
    EXPECT_EQ(played.detector.history().size(), before.history().size());
    EXPECT_EQ(played.detector.history().back(0).direction, before.history().back(0).direction);
}

TEST(EventDetector, StandsAnyTimes) {
    EventDetector detector;
    constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
    for (const std::int64_t time_ns : {-kMost - 1, -kMost, -1L, 0L, 1L, 2L, 3L, kMost - 1, kMost}) {
        detector.add(time_ns, right_by(static_cast<double>(time_ns % 90)));
        EXPECT_TRUE(std::isfinite(glm::length(detector.velocity_deg_per_s())));
    }
}

TEST(EventDetector, KnowsNothingBeforeThreeSamples) {
    EventDetector detector;
    EXPECT_FALSE(detector.event_before().has_value());
    detector.add(0, right_by(0.0));
    detector.add(2'000'000, right_by(0.0));
    EXPECT_FALSE(detector.event_before().has_value());
    detector.add(4'000'000, right_by(0.0));
    EXPECT_EQ(detector.event_before(), EyeEvent::Fixation);
}

TEST(EventDetector, GoesAlongWhenTheWorldTurns) {
    Played turned(500.0);
    turned.rest(0.5, 10.0);
    const glm::dquat yaw = glm::angleAxis(glm::radians(90.0), glm::dvec3{0.0, 1.0, 0.0});
    const double speed = glm::length(turned.detector.velocity_deg_per_s());
    const glm::dvec3 looked = turned.detector.history().back(0).direction;
    turned.detector.turn(yaw);
    EXPECT_LT(glm::distance(turned.detector.history().back(0).direction, yaw * looked), 1e-12);
    turned.step(yaw * right_by(5.02));
    turned.step(yaw * right_by(5.04));
    EXPECT_EQ(turned.detector.event(), EyeEvent::Pursuit);
    EXPECT_NEAR(glm::length(turned.detector.velocity_deg_per_s()), speed, 1e-6);
}

}  // namespace
}  // namespace gazeloop::gaze
