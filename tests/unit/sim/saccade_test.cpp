#include "sim/saccade.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/turned_direction.h"
#include "tests/unit/sim/statistics.h"

namespace gazeloop::sim {
namespace {

using tests::angle_deg;

constexpr glm::dvec3 kAhead{0.0, 0.0, -1.0};

class SaccadeOf : public testing::TestWithParam<double> {};

TEST_P(SaccadeOf, KeepsToTheMainSequence) {
    const double amplitude_deg = GetParam();
    const glm::dvec3 to = turned_direction(kAhead, glm::radians(amplitude_deg) * 0.6,
                                           glm::radians(amplitude_deg) * 0.8);
    const Saccade saccade(kAhead, to, 1.0);
    const gaze::MainSequence expected = gaze::main_sequence(amplitude_deg);
    EXPECT_NEAR(saccade.duration_s(), expected.duration_s, 1e-12);

    constexpr int kSteps = 2000;
    const double step_s = saccade.duration_s() / kSteps;
    double peak = 0.0;
    double before = 0.0;
    for (int i = 1; i <= kSteps; ++i) {
        const double done = saccade.progress(i * step_s);
        EXPECT_GE(done, before - 1e-15) << "goes back at step " << i;
        peak = std::max(peak, (done - before) * amplitude_deg / step_s);
        before = done;
    }
    // The mean over a step of 1/2000 is below the peak by f'' h^2 / 24, far less than a thousandth.
    EXPECT_NEAR(peak, expected.peak_deg_per_s, 1e-3 * expected.peak_deg_per_s);
    EXPECT_NEAR(angle_deg(saccade.at(saccade.duration_s() / 2.0), kAhead), amplitude_deg / 2.0,
                1e-6);
    EXPECT_EQ(saccade.at(1.0), to);
    EXPECT_NEAR(angle_deg(saccade.at(0.0), kAhead), 0.0, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Amplitudes, SaccadeOf,
                         testing::Values(1e-3, 0.1, 1.0, 5.0, 12.0, 23.0, 45.0, 90.0, 179.0));

TEST(Saccade, IsFasterWithVigour) {
    const glm::dvec3 to = turned_direction(kAhead, 0.2, 0.0);
    EXPECT_NEAR(Saccade(kAhead, to, 2.0).duration_s(), Saccade(kAhead, to, 1.0).duration_s() / 2.0,
                1e-15);
}

TEST(Saccade, TurnsAboutWithoutAnAxis) {
    const Saccade saccade(kAhead, -kAhead, 1.0);
    EXPECT_NEAR(glm::length(saccade.at(saccade.duration_s() / 2.0)), 1.0, 1e-12);
    EXPECT_NEAR(angle_deg(saccade.at(saccade.duration_s() / 2.0), kAhead), 90.0, 1e-6);
    EXPECT_EQ(Saccade(kAhead).at(0.0), kAhead);
}

TEST(TurnedDirection, TurnsRightAndUpByTheOffset) {
    const glm::dvec3 right = turned_direction(kAhead, 0.1, 0.0);
    EXPECT_NEAR(right.x, std::sin(0.1), 1e-15);
    EXPECT_NEAR(turned_direction(kAhead, 0.0, 0.1).y, std::sin(0.1), 1e-15);
    for (const glm::dvec3& d : {kAhead, glm::dvec3{0.0, 1.0, 0.0}, glm::dvec3{0.6, -0.8, 0.0}}) {
        for (const double angle : {0.0, 1e-9, 0.3, 3.0, 40.0, 1e6}) {
            const glm::dvec3 turned = turned_direction(d, angle, -angle);
            EXPECT_NEAR(glm::length(turned), 1.0, 1e-12);
            EXPECT_NEAR(glm::dot(turned, d), std::cos(std::sqrt(2.0) * angle), 1e-9);
        }
    }
}

}  // namespace
}  // namespace gazeloop::sim
