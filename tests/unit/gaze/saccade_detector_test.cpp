#include "runtime/gaze/saccade_detector.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>
#include <vector>

#include "runtime/gaze/main_sequence.h"

namespace gazeloop::gaze {
namespace {

constexpr double kRate_hz = 500.0;
constexpr std::int64_t kInterval_ns = 2'000'000;

glm::dvec3 right_by(double deg) {
    return {std::sin(glm::radians(deg)), 0.0, -std::cos(glm::radians(deg))};
}

/// Azimuths over time, fed in one go; the saccades that are found.
class Played {
  public:
    explicit Played(double rate_hz = kRate_hz) : detector_(rate_hz) {}

    void rest(double deg, int samples) {
        for (int i = 0; i < samples; ++i) {
            look(deg);
        }
    }
    void saccade(double from_deg, double to_deg) {
        const SaccadeCourse course(std::abs(to_deg - from_deg), 1.0);
        for (double t = 0.0; t < course.duration_s(); t += 1.0 / kRate_hz) {
            look(std::lerp(from_deg, to_deg, course.progress(t)));
        }
    }
    void look(double deg) {
        now_ns_ += kInterval_ns;
        if (const auto seen = detector_.add(now_ns_, right_by(deg))) {
            found.push_back(*seen);
        }
    }
    void break_off() { detector_.break_off(); }

    std::vector<SeenSaccade> found;

  private:
    SaccadeDetector detector_;
    std::int64_t now_ns_ = 0;
};

TEST(SaccadeDetector, FindsSaccadesWithTheirAmplitudeAndPeak) {
    Played played;
    played.rest(0.0, 100);
    for (const auto& [from, to] : {std::pair{0.0, 10.0}, {10.0, -5.0}, {-5.0, -2.0}}) {
        played.saccade(from, to);
        played.rest(to, 100);
    }
    ASSERT_EQ(played.found.size(), 3U);
    const std::vector<double> amplitudes{10.0, 15.0, 3.0};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(played.found[i].amplitude_deg, amplitudes[i], 0.3);
        const double peak = main_sequence(amplitudes[i]).peak_deg_per_s;
        // A window of 8 or 12 ms takes some of the peak.
        EXPECT_LT(played.found[i].peak_deg_per_s, peak);
        EXPECT_GT(played.found[i].peak_deg_per_s, 0.8 * peak);
    }
}

TEST(SaccadeDetector, TellsASaccadeOnlyOnceTheGazeHasSettled) {
    Played played;
    played.rest(0.0, 100);
    played.saccade(0.0, 10.0);
    played.rest(10.0, 20);
    EXPECT_TRUE(played.found.empty());
    played.rest(10.0, 20);
    EXPECT_EQ(played.found.size(), 1U);
}

TEST(SaccadeDetector, LeavesOutWhatLiesBesideABreak) {
    Played played;
    played.rest(0.0, 100);
    played.saccade(0.0, 10.0);
    played.rest(10.0, 10);
    played.break_off();  // 20 ms after the end
    played.rest(10.0, 10);
    played.saccade(10.0, 0.0);  // 20 ms after the break
    played.rest(0.0, 100);
    EXPECT_TRUE(played.found.empty());
    played.saccade(0.0, 10.0);
    played.rest(10.0, 100);
    EXPECT_EQ(played.found.size(), 1U);
}

TEST(SaccadeDetector, LeavesOutWhatNoEyeDoes) {
    Played played;
    played.rest(0.0, 100);
    played.rest(40.0, 100);  // at once: 4000 deg/s
    EXPECT_TRUE(played.found.empty());
    for (int i = 0; i < 400; ++i) {
        played.look(40.0 - 0.1 * i);  // 50 deg/s for .8 s
    }
    played.rest(0.0, 100);
    EXPECT_TRUE(played.found.empty());
}

TEST(SaccadeDetector, FollowsNoiseUpAndDown) {
    SaccadeDetector detector(kRate_hz);
    std::int64_t now_ns = 0;
    const auto shake = [&](double deg, int samples) {
        // The window is six samples long: its ends always lie on different sides.
        for (int i = 0; i < samples; ++i) {
            now_ns += kInterval_ns;
            detector.add(now_ns, right_by(deg * ((i / 2) % 2)));
        }
    };
    shake(0.001, 500);
    EXPECT_EQ(detector.threshold_deg_per_s(), 45.0);
    shake(2.0, 2000);
    EXPECT_GT(detector.threshold_deg_per_s(), 200.0);
    shake(0.001, 5000);
    EXPECT_EQ(detector.threshold_deg_per_s(), 45.0);
}

TEST(SaccadeDetector, HasAWindowOfTwoSamplesOrTenMilliseconds) {
    EXPECT_NEAR(SaccadeDetector(90.0).window_s(), 2.0 / 90.0, 1e-12);
    EXPECT_NEAR(SaccadeDetector(200.0).window_s(), 0.010, 1e-12);
    EXPECT_NEAR(SaccadeDetector(1000.0).window_s(), 0.010, 1e-12);
    EXPECT_GT(SaccadeDetector(1e6).window_s(), 0.0);
    EXPECT_GT(SaccadeDetector(10.0).window_s(), 0.0);
}

TEST(AngleBetween, IsExactForSmallAndLargeAngles) {
    for (const double deg : {0.0, 1e-9, 1e-3, 1.0, 2.8, 2.9, 30.0, 90.0, 179.0}) {
        EXPECT_NEAR(angle_between_deg(right_by(0.0), right_by(deg)), deg, 1e-6 * deg + 1e-12);
    }
}

}  // namespace
}  // namespace gazeloop::gaze
