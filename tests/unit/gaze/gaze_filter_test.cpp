#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <random>

#include "runtime/gaze/filter/fixation_filter.h"
#include "runtime/gaze/filter/one_euro_filter.h"

namespace gazeloop::gaze {
namespace {

constexpr std::int64_t kInterval_ns = 4'000'000;
constexpr double kInterval_s = 0.004;

glm::dvec3 right_by(double deg) {
    return {std::sin(glm::radians(deg)), 0.0, -std::cos(glm::radians(deg))};
}

double right_deg(const glm::dvec3& direction) {
    return glm::degrees(std::atan2(direction.x, -direction.z));
}

TEST(OneEuroFilter, IsALowPassOfItsCutOffAtRest) {
    OneEuroFilter filter({.least_cutoff_hz = 5.0, .cutoff_hz_per_deg_per_s = 0.0});
    filter.add(0, right_by(0.0));
    // By hand: r = 2 pi 5 .004 = .12566, weight r / (1 + r) = .11164; the rest decays by its power.
    const double r = 2.0 * std::numbers::pi * 5.0 * kInterval_s;
    double left = 1.0;
    for (int i = 1; i <= 20; ++i) {
        left /= 1.0 + r;
        EXPECT_NEAR(right_deg(filter.add(i * kInterval_ns, right_by(1.0))), 1.0 - left, 1e-5);
    }
}

TEST(OneEuroFilter, StatesTheDelayThatARampShows) {
    for (const double per_speed : {0.0, 0.05}) {
        OneEuroFilter filter({.least_cutoff_hz = 4.0, .cutoff_hz_per_deg_per_s = per_speed});
        constexpr double kSpeed_deg_per_s = 20.0;
        double behind_deg = 0.0;
        for (int i = 0; i < 2000; ++i) {
            const double deg = kSpeed_deg_per_s * i * kInterval_s - 80.0;
            behind_deg = deg - right_deg(filter.add(i * kInterval_ns, right_by(deg)));
        }
        EXPECT_GT(filter.delay_s(), 0.01);
        EXPECT_NEAR(behind_deg / kSpeed_deg_per_s, filter.delay_s(), 1e-4);
    }
}

TEST(OneEuroFilter, LagsLessTheFasterTheGaze) {
    OneEuroFilter slow({});
    OneEuroFilter fast({});
    for (int i = 0; i < 500; ++i) {
        slow.add(i * kInterval_ns, right_by(1.0 * i * kInterval_s));
        fast.add(i * kInterval_ns, right_by(30.0 * i * kInterval_s));
    }
    EXPECT_GT(slow.delay_s(), 1.5 * fast.delay_s());
}

TEST(OneEuroFilter, BeginsAnew) {
    OneEuroFilter filter({});
    filter.add(0, right_by(0.0));
    filter.add(kInterval_ns, right_by(1.0));
    EXPECT_GT(filter.delay_s(), 0.0);
    filter.reset();
    EXPECT_EQ(filter.add(2 * kInterval_ns, right_by(5.0)), right_by(5.0));
    EXPECT_EQ(filter.delay_s(), 0.0);
    EXPECT_EQ(filter.add(2 * kInterval_ns, right_by(7.0)), right_by(7.0));  // the same time
    EXPECT_EQ(filter.add(0, right_by(9.0)), right_by(9.0));                 // an earlier one
}

TEST(FixationFilter, CalmsAFixation) {
    FixationFilter filter({});
    std::mt19937 engine{7};
    std::normal_distribution<double> noise_deg(0.0, 0.05);
    double raw = 0.0;
    double filtered = 0.0;
    for (int i = 0; i < 2000; ++i) {
        const double deg = noise_deg(engine);
        const double out =
            right_deg(filter.add(i * kInterval_ns, right_by(deg), EyeEvent::Fixation));
        if (i > 100) {
            raw += deg * deg;
            filtered += out * out;
        }
    }
    // An exponential mean of weight w keeps w / (2 - w) of the variance: .0741 here.
    const double weight = kInterval_s / (0.025 + kInterval_s);
    EXPECT_NEAR(filtered / raw, weight / (2.0 - weight), 0.02);
    EXPECT_NEAR(filter.delay_s(), 0.025, 1e-6);
}

TEST(FixationFilter, IsTheMeanOfAFixationAtFirst) {
    FixationFilter filter({});
    filter.add(0, right_by(0.0), EyeEvent::Fixation);
    filter.add(kInterval_ns, right_by(0.1), EyeEvent::Fixation);
    EXPECT_NEAR(right_deg(filter.add(2 * kInterval_ns, right_by(0.2), EyeEvent::Fixation)), 0.1,
                1e-6);
    EXPECT_NEAR(filter.delay_s(), kInterval_s, 1e-12);  // (0 + 1 + 2) / 3 intervals
}

TEST(FixationFilter, PassesEverythingElseAsItIs) {
    FixationFilter filter({});
    for (int i = 0; i < 10; ++i) {
        filter.add(i * kInterval_ns, right_by(0.01 * (i % 2)), EyeEvent::Fixation);
    }
    EXPECT_GT(filter.delay_s(), 0.0);
    for (const EyeEvent event :
         {EyeEvent::Saccade, EyeEvent::Oscillation, EyeEvent::Pursuit, EyeEvent::Lost}) {
        EXPECT_EQ(filter.add(11 * kInterval_ns, right_by(1.0), event), right_by(1.0));
        EXPECT_EQ(filter.delay_s(), 0.0);
    }
    EXPECT_EQ(filter.add(12 * kInterval_ns, right_by(2.0), EyeEvent::Fixation), right_by(2.0));
}

TEST(FixationFilter, FollowsAGazeThatDeparts) {
    FixationFilter filter({});
    for (int i = 0; i < 20; ++i) {
        filter.add(i * kInterval_ns, right_by(0.0), EyeEvent::Fixation);
    }
    EXPECT_EQ(filter.add(20 * kInterval_ns, right_by(0.4), EyeEvent::Fixation), right_by(0.4));
    EXPECT_EQ(filter.delay_s(), 0.0);
}

}  // namespace
}  // namespace gazeloop::gaze
