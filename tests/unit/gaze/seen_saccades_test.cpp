#include "runtime/gaze/events/seen_saccades.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "runtime/gaze/main_sequence.h"
#include "tests/support/allocation_counter.h"

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
    void rest(double deg, int samples) {
        for (int i = 0; i < samples; ++i) {
            look(deg);
        }
    }
    void saccade(double from_deg, double to_deg, double vigour = 1.0) {
        const SaccadeCourse course(std::abs(to_deg - from_deg), vigour);
        for (double t = 0.0; t < course.duration_s(); t += 1.0 / kRate_hz) {
            look(std::lerp(from_deg, to_deg, course.progress(t)));
        }
    }
    void look(double deg) { add(right_by(deg)); }
    void lose() { add(std::nullopt); }

    std::vector<SeenSaccade> found;

  private:
    void add(const std::optional<glm::dvec3>& direction) {
        now_ns_ += kInterval_ns;
        if (const auto seen = seen_.add(now_ns_, direction)) {
            found.push_back(*seen);
        }
    }

    SeenSaccades seen_;
    std::int64_t now_ns_ = 0;
};

TEST(SeenSaccades, HaveTheirAmplitudeAndPeak) {
    Played played;
    played.rest(0.0, 100);
    for (const auto& [from, to] : {std::pair{0.0, 10.0}, {10.0, -5.0}, {-5.0, -2.0}}) {
        played.saccade(from, to);
        played.rest(to, 100);
    }
    ASSERT_EQ(played.found.size(), 3U);
    const std::vector<double> amplitudes{10.0, 15.0, 3.0};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(played.found[i].amplitude_deg, amplitudes[i], 0.1);
        const double peak = main_sequence(amplitudes[i]).peak_deg_per_s;
        // A window of 20 ms takes some of the peak, most where the saccade is short.
        EXPECT_LT(played.found[i].peak_deg_per_s, peak);
        EXPECT_GT(played.found[i].peak_deg_per_s, 0.7 * peak);
    }
}

TEST(SeenSaccades, AreFoundWhereAFilterHasMadeThemLong) {
    Played played;
    played.rest(0.0, 100);
    played.saccade(0.0, 15.0, 0.25);  // 216 ms
    played.rest(15.0, 100);
    ASSERT_EQ(played.found.size(), 1U);
    EXPECT_NEAR(played.found[0].amplitude_deg, 15.0, 0.5);
    EXPECT_NEAR(played.found[0].peak_deg_per_s, 0.25 * main_sequence(15.0).peak_deg_per_s, 2.0);
}

TEST(SeenSaccades, AreToldOnlyOnceTheGazeHasSettled) {
    Played played;
    played.rest(0.0, 100);
    played.saccade(0.0, 10.0);
    played.rest(10.0, 25);
    EXPECT_TRUE(played.found.empty());
    played.rest(10.0, 40);
    EXPECT_EQ(played.found.size(), 1U);
}

TEST(SeenSaccades, LeaveOutWhatLiesBesideALoss) {
    Played played;
    played.rest(0.0, 100);
    played.saccade(0.0, 10.0);
    played.rest(10.0, 10);
    played.lose();  // 20 ms after the end
    played.rest(10.0, 15);
    played.saccade(10.0, 0.0);  // 30 ms after the loss
    played.rest(0.0, 100);
    EXPECT_TRUE(played.found.empty());
    played.saccade(0.0, 10.0);
    played.rest(10.0, 100);
    EXPECT_EQ(played.found.size(), 1U);
}

TEST(SeenSaccades, LeaveOutWhatNoEyeDoes) {
    Played played;
    played.rest(0.0, 100);
    played.rest(60.0, 100);  // at once: 60 deg within the window
    EXPECT_TRUE(played.found.empty());
    for (int i = 0; i < 400; ++i) {
        played.look(60.0 - 0.15 * i);  // 75 deg/s for .8 s
    }
    played.rest(0.0, 100);
    EXPECT_TRUE(played.found.empty());
}

TEST(SeenSaccades, BearAnyTimesAndAllocateNothing) {
    SeenSaccades seen;
    const std::size_t before = gazeloop::tests::allocations_of_this_thread();
    constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
    for (const std::int64_t time_ns : {-kMost, std::int64_t{0}, std::int64_t{0}, std::int64_t{1},
                                       std::int64_t{-5}, kMost - 1, kMost}) {
        EXPECT_FALSE(seen.add(time_ns, right_by(static_cast<double>(time_ns % 7))).has_value());
        EXPECT_FALSE(seen.add(time_ns, std::nullopt).has_value());
    }
    EXPECT_EQ(gazeloop::tests::allocations_of_this_thread(), before);
}

}  // namespace
}  // namespace gazeloop::gaze
