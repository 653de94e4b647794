#include "sim/person.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <vector>

#include "sim/saccade.h"
#include "tests/unit/sim/statistics.h"

namespace gazeloop::sim {
namespace {

using namespace tests;

constexpr HeadTerms kStill{.sway_deg = 0.0, .turn_percent = 0.0};
/// Saccades and nothing else.
constexpr EyeTerms kPlain{.saccade_scatter_percent = 0.0,
                          .drift_deg = 0.0,
                          .microsaccades_per_s = 0.0,
                          .blinks_per_min = 0.0};

/// A stretch of one kind of movement, sampled.
struct Stretch {
    Movement movement = Movement::Fixation;
    double begin_s = 0.0;
    double end_s = 0.0;
    double peak_deg_per_s = 0.0;
    std::vector<glm::dvec3> gaze{};  ///< unit, in world
};

/// Whole stretches of a person's gaze; the first and the last, which are cut off, are left out.
std::vector<Stretch> stretches_of(Person& person, double seconds, double rate_hz) {
    std::vector<Stretch> all;
    std::optional<glm::dvec3> before;
    const auto count = static_cast<int>(seconds * rate_hz);
    for (int i = 0; i < count; ++i) {
        const double time_s = i / rate_hz;
        const TrueGaze truth = person.at(time_s);
        const glm::dvec3 gaze = glm::normalize(truth.target_m);
        if (all.empty() || all.back().movement != truth.movement) {
            all.push_back({.movement = truth.movement, .begin_s = time_s});
        }
        if (before) {
            all.back().peak_deg_per_s =
                std::max(all.back().peak_deg_per_s, angle_deg(*before, gaze) * rate_hz);
        }
        all.back().end_s = time_s + 1.0 / rate_hz;
        all.back().gaze.push_back(gaze);
        before = gaze;
    }
    return {all.begin() + 1, all.end() - 1};
}

TEST(Person, FollowsTheMainSequence) {
    constexpr double kRate_hz = 4000.0;
    Person person(kPlain, kStill, 5);
    std::size_t saccades = 0;
    double smallest = 90.0;
    double largest = 0.0;
    for (const Stretch& stretch : stretches_of(person, 60.0, kRate_hz)) {
        if (stretch.movement != Movement::Saccade) {
            continue;
        }
        ++saccades;
        // The sample before is still in fixation, where it stands where the saccade begins.
        const double amplitude =
            angle_deg(glm::normalize(person.at(stretch.begin_s - 1.0 / kRate_hz).target_m),
                      glm::normalize(person.at(stretch.end_s).target_m));
        const gaze::MainSequence expected = gaze::main_sequence(amplitude);
        smallest = std::min(smallest, amplitude);
        largest = std::max(largest, amplitude);
        EXPECT_NEAR(stretch.end_s - stretch.begin_s, expected.duration_s, 1.01 / kRate_hz);
        // Sampled, the peak may be missed by f'' h^2 / 8 <= 4 V (h / D)^2, V the peak.
        const double step = 1.0 / (kRate_hz * expected.duration_s);
        EXPECT_NEAR(stretch.peak_deg_per_s, expected.peak_deg_per_s,
                    8.0 * expected.peak_deg_per_s * step * step + 1e-3);
    }
    EXPECT_GT(saccades, 150U);
    EXPECT_LT(smallest, 3.0);
    EXPECT_GT(largest, 20.0);
}

TEST(Person, ScattersPeakVelocitiesByAsMuchAsAsked) {
    EyeTerms eye = kPlain;
    eye.saccade_scatter_percent = 20.0;
    Person person(eye, kStill, 6);
    std::vector<double> logarithms;
    for (const Stretch& stretch : stretches_of(person, 200.0, 1000.0)) {
        if (stretch.movement == Movement::Saccade) {
            const double amplitude =
                angle_deg(glm::normalize(person.at(stretch.begin_s - 1e-3).target_m),
                          glm::normalize(person.at(stretch.end_s).target_m));
            logarithms.push_back(
                std::log(stretch.peak_deg_per_s / gaze::main_sequence(amplitude).peak_deg_per_s));
        }
    }
    // n > 600: the standard error of an SD of .2 is .2 / sqrt(2 n) < .006, of the mean < .0082;
    // a peak sampled at 1 kHz loses up to 1.5 % of the shortest saccades.
    ASSERT_GT(logarithms.size(), 600U);
    EXPECT_NEAR(standard_deviation(logarithms), 0.2, 0.02);
    EXPECT_NEAR(mean(logarithms), 0.0, 0.03);
}

TEST(Person, FixatesForAsLongAsPeopleDo) {
    Person person(kPlain, kStill, 6);
    std::vector<double> logarithms;
    for (const Stretch& stretch : stretches_of(person, 600.0, 1000.0)) {
        if (stretch.movement == Movement::Fixation) {
            logarithms.push_back(std::log(stretch.end_s - stretch.begin_s));
        }
    }
    ASSERT_GT(logarithms.size(), 1500U);
    // Standard errors with n = 1500 and sigma = .6: of the mean .0155, of the median .0194, of the
    // SD .011; bounds are four of them. A sample's period changes the shortest of 50 ms by 2 %.
    EXPECT_NEAR(std::exp(median(logarithms)), 0.224, 0.224 * 4.0 * 0.0194);
    EXPECT_NEAR(mean(logarithms), std::log(0.224), 4.0 * 0.0155);
    EXPECT_NEAR(standard_deviation(logarithms), 0.6, 0.044);
}

TEST(Person, MovesWithinAFixationAsPeopleDo) {
    // With everything that a person does on top, and no tracker: .16 deg, both axes together, in
    // the median of labelled fixations. Sines draw their frequencies once: between seeds the median
    // varies by about .01.
    EyeTerms eye;
    eye.blinks_per_min = 0.0;
    std::vector<double> medians;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        Person person(eye, kStill, seed);
        std::vector<double> deviations;
        for (const Stretch& stretch : stretches_of(person, 100.0, 250.0)) {
            if (stretch.movement != Movement::Fixation || stretch.gaze.size() < 10) {
                continue;
            }
            glm::dvec3 sum{0.0};
            for (const glm::dvec3& gaze : stretch.gaze) {
                sum += gaze;
            }
            const glm::dvec3 centre = glm::normalize(sum);
            double squares = 0.0;
            for (const glm::dvec3& gaze : stretch.gaze) {
                squares += std::pow(angle_deg(gaze, centre), 2.0);
            }
            deviations.push_back(std::sqrt(squares / static_cast<double>(stretch.gaze.size())));
        }
        medians.push_back(median(deviations));
    }
    EXPECT_NEAR(mean(medians), 0.16, 0.02);
}

TEST(Person, MakesMicrosaccadesAtTheirRate) {
    EyeTerms eye = kPlain;
    eye.saccade_deg = 0.0;
    eye.microsaccades_per_s = 1.5;
    Person person(eye, kStill, 7);
    std::vector<double> amplitudes;
    glm::dvec3 from{0.0};
    bool under_way = false;
    constexpr double kSeconds = 1000.0;
    for (int i = 0; i < static_cast<int>(kSeconds) * 500; ++i) {
        const TrueGaze truth = person.at(i / 500.0);
        EXPECT_EQ(truth.movement, Movement::Fixation);
        if (truth.microsaccade && !under_way) {
            from = person.at((i - 1) / 500.0).target_m;
        } else if (!truth.microsaccade && under_way) {
            amplitudes.push_back(angle_deg(from, truth.target_m));
        }
        under_way = truth.microsaccade;
        EXPECT_LT(angle_deg(truth.target_m, person.at(0.0).target_m), 2.0);
    }
    // A Poisson process, slowed by the 16 to 18 ms that each takes: 1463 in 1000 s, SD < 38.
    EXPECT_NEAR(static_cast<double>(amplitudes.size()), 1463.0, 4.0 * 38.0);
    EXPECT_GT(quantile(amplitudes, 0.0), 0.099);
    EXPECT_LT(quantile(amplitudes, 1.0), 1.001);
    // Uniform in the logarithm: half below sqrt(.1).
    EXPECT_NEAR(median(amplitudes), std::sqrt(0.1), 0.05);
}

TEST(Person, BlinksFifteenTimesAMinute) {
    Person person({}, kStill, 7);
    constexpr double kSeconds = 1800.0;
    constexpr double kRate_hz = 200.0;
    std::vector<double> durations;
    double closed_s = 0.0;
    double least = 1.0;
    for (int i = 0; i < static_cast<int>(kSeconds * kRate_hz); ++i) {
        const double openness = person.at(i / kRate_hz).eyes[0].openness;
        EXPECT_TRUE(openness >= 0.0 && openness <= 1.0);
        if (openness < 1.0) {
            closed_s += 1.0 / kRate_hz;
            least = std::min(least, openness);
        } else if (closed_s > 0.0) {
            durations.push_back(closed_s);
            closed_s = 0.0;
        }
    }
    // 450 expected; pauses have an SD of 3.25 s, so that the count's is 450 * 3.25 / 4 / sqrt(450),
    // 17.
    EXPECT_NEAR(static_cast<double>(durations.size()), 450.0, 4.0 * 17.3);
    EXPECT_GE(quantile(durations, 0.0), 0.1 - 2.0 / kRate_hz);
    EXPECT_LE(quantile(durations, 1.0), 0.4 + 2.0 / kRate_hz);
    EXPECT_NEAR(median(durations), 0.25, 0.03);
    EXPECT_LT(least, 0.01);
    EXPECT_EQ(person.at(0.0).eyes[0].openness, 1.0);
}

TEST(Person, TurnsTheHeadAsFastAsPeopleDo) {
    // Recorded in a headset: yaw at 38 to 84 deg/s at P95, up to 152.
    constexpr double kRate_hz = 100.0;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        Person person({}, {}, seed);
        std::vector<double> speeds;
        std::optional<double> before_deg;
        for (int i = 0; i < 300 * static_cast<int>(kRate_hz); ++i) {
            const glm::dvec3 ahead =
                person.head_at(i / kRate_hz).orientation * glm::dvec3{0.0, 0.0, -1.0};
            const double yaw_deg = glm::degrees(std::atan2(ahead.x, -ahead.z));
            if (before_deg) {
                speeds.push_back(std::abs(yaw_deg - *before_deg) * kRate_hz);
            }
            before_deg = yaw_deg;
        }
        EXPECT_GT(quantile(speeds, 0.95), 38.0) << seed;
        EXPECT_LT(quantile(speeds, 0.95), 84.0) << seed;
        EXPECT_GT(quantile(speeds, 1.0), 84.0) << seed;
        EXPECT_LT(quantile(speeds, 1.0), 200.0) << seed;
    }
}

TEST(Person, CounterRotatesTheEyesWhileTheHeadTurns) {
    EyeTerms eye = kPlain;
    eye.distance_m = 1000.0;
    HeadTerms head;
    head.pivot_m = 0.0;
    Person person(eye, head, 8);
    std::size_t turning = 0;
    double farthest_deg = 0.0;
    constexpr double kStep_s = 0.005;
    for (int i = 0; i < 20000; ++i) {
        const TrueGaze a = person.at(i * kStep_s);
        const TrueGaze b = person.at((i + 1) * kStep_s);
        farthest_deg = std::max(farthest_deg, angle_deg(a.eyes[0].direction, {0.0, 0.0, -1.0}));
        if (a.movement != Movement::Fixation || b.movement != Movement::Fixation) {
            continue;
        }
        if (angle_deg(a.target_m, b.target_m) == 0.0) {
            // The same point is seen: the eye has turned back by what the head has turned.
            const glm::dvec3 expected =
                glm::conjugate(b.head.orientation) * a.head.orientation * a.eyes[0].direction;
            EXPECT_NEAR(angle_deg(b.eyes[0].direction, expected), 0.0, 1e-2);
            turning += angle_deg(a.eyes[0].direction, b.eyes[0].direction) > 30.0 * kStep_s ? 1 : 0;
        }
    }
    EXPECT_GT(turning, 200U);
    EXPECT_LT(farthest_deg, 55.0) << "no eye turns that far";
    EXPECT_GT(farthest_deg, 25.0) << "gaze shifts with the head go beyond the eyes' own";
}

TEST(Person, LetsTheGazeSlipWithAWeakReflex) {
    EyeTerms eye = kPlain;
    HeadTerms head;
    head.pivot_m = 0.0;
    head.vor_gain = 0.0;
    Person person(eye, head, 8);
    double moved_deg = 0.0;
    double fixed_deg = 0.0;
    for (int i = 0; i < 20000; ++i) {
        const TrueGaze a = person.at(i * 0.005);
        const TrueGaze b = person.at((i + 1) * 0.005);
        if (a.movement == Movement::Fixation && b.movement == Movement::Fixation &&
            angle_deg(a.eyes[0].direction, b.eyes[0].direction) < 1e-3) {
            fixed_deg += 0.005;
            moved_deg += angle_deg(a.target_m, b.target_m);
        }
    }
    EXPECT_GT(fixed_deg, 50.0) << "without the reflex the eyes stand still in the head";
    EXPECT_GT(moved_deg, 200.0);
}

TEST(Person, PursuesAtTheAskedSpeed) {
    EyeTerms eye = kPlain;
    eye.pursuit_percent = 50.0;
    eye.pursuit_deg_per_s = 20.0;
    Person person(eye, kStill, 9);
    std::size_t pursuits = 0;
    std::size_t fixations = 0;
    for (const Stretch& stretch : stretches_of(person, 100.0, 500.0)) {
        pursuits += stretch.movement == Movement::Pursuit ? 1 : 0;
        fixations += stretch.movement == Movement::Fixation ? 1 : 0;
        if (stretch.movement == Movement::Pursuit && stretch.gaze.size() > 2) {
            EXPECT_NEAR(angle_deg(stretch.gaze[1], stretch.gaze[2]) * 500.0, 20.0, 1e-3);
        }
    }
    // n > 250, p = 1/2: four standard errors are .127.
    EXPECT_NEAR(static_cast<double>(pursuits) / static_cast<double>(pursuits + fixations), 0.5,
                0.127);
}

TEST(Person, ConvergesWhereItLooks) {
    EyeTerms eye;
    eye.distance_m = 0.5;
    eye.distance_spread = 0.3;
    eye.ipd_mm = 70.0;
    Person person(eye, {}, 9);
    std::vector<double> distances;
    for (int i = 0; i < 20000; ++i) {
        const TrueGaze truth = person.at(i * 0.02);
        const glm::dvec3 target_m =
            gaze::transform_point(gaze::inverse(truth.head), truth.target_m);
        EXPECT_DOUBLE_EQ(truth.eyes[0].origin_m.x, -0.035);
        EXPECT_DOUBLE_EQ(truth.eyes[1].origin_m.x, 0.035);
        for (const gaze::EyeRay& ray : truth.eyes) {
            EXPECT_NEAR(glm::length(ray.direction), 1.0, 1e-12);
            EXPECT_NEAR(angle_deg(ray.direction, target_m - ray.origin_m), 0.0, 1e-6);
        }
        distances.push_back(std::log(glm::length(truth.target_m)));
    }
    // About 1300 fixations in 400 s.
    EXPECT_NEAR(std::exp(median(distances)), 0.5, 0.03);
    EXPECT_NEAR(standard_deviation(distances), 0.3, 0.04);
}

TEST(Person, IsTheSameWheneverItIsAsked) {
    Person forward({}, {}, 3);
    Person backward({}, {}, 3);
    (void)backward.at(50.0);
    for (int i = 0; i < 500; ++i) {
        const TrueGaze there = backward.at(50.0 - i * 0.1);
        const TrueGaze here = forward.at(50.0 - i * 0.1);
        EXPECT_EQ(there.eyes[0].direction, here.eyes[0].direction);
        EXPECT_EQ(there.head.orientation, here.head.orientation);
        EXPECT_EQ(there.eyes[1].openness, here.eyes[1].openness);
    }
    EXPECT_NE(Person({}, {}, 4).at(1.0).target_m, Person({}, {}, 3).at(1.0).target_m);
}

TEST(Person, AddsTermsWithoutChangingTheOthers) {
    // Times and targets of the saccades stay where they are, whatever lies on top.
    Person plain(kPlain, kStill, 11);
    EyeTerms rich = kPlain;
    rich.drift_deg = 0.1;
    rich.microsaccades_per_s = 2.0;
    rich.blinks_per_min = 20.0;
    rich.distance_spread = 0.5;
    Person other(rich, kStill, 11);
    for (int i = 0; i < 20000; ++i) {
        const double time_s = i * 0.005;
        const TrueGaze a = plain.at(time_s);
        const TrueGaze b = other.at(time_s);
        EXPECT_EQ(a.movement, b.movement);
        EXPECT_LT(angle_deg(a.target_m, b.target_m), 3.0);
    }
    // Head terms change where the gaze goes, and neither for how long nor when lids close.
    Person turning(rich, {}, 11);
    for (int i = 0; i < 20000; ++i) {
        EXPECT_EQ(turning.at(i * 0.005).eyes[0].openness, other.at(i * 0.005).eyes[0].openness);
    }
}

TEST(Person, LooksAboutInTheSmallestField) {
    EyeTerms eye = kPlain;
    eye.saccade_deg = 0.01;
    Person person(eye, kStill, 1);
    for (int i = 0; i < 1000; ++i) {
        EXPECT_LT(angle_deg(person.at(i * 0.01).target_m, {0.0, 0.0, -1.0}), 0.0201);
    }
    EXPECT_GT(angle_deg(person.at(0.0).target_m, person.at(10.0).target_m), 0.0);
}

TEST(Person, KeepsStillWithoutAnyTerm) {
    EyeTerms eye = kPlain;
    eye.saccade_deg = 0.0;
    Person person(eye, kStill, 1);
    EXPECT_FALSE(person.head_moves());
    for (const double time_s : {0.0, 1.0, 1e6, 9.2e9}) {
        const TrueGaze truth = person.at(time_s);
        EXPECT_EQ(truth.target_m, glm::dvec3(0.0, 0.0, -1.5));
        EXPECT_EQ(truth.head.orientation, glm::dquat(1.0, 0.0, 0.0, 0.0));
        EXPECT_EQ(truth.movement, Movement::Fixation);
        EXPECT_EQ(truth.eyes[0].openness, 1.0);
    }
}

}  // namespace
}  // namespace gazeloop::sim
