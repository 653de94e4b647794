#include "sim/gaze_generator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "drivers/trace/native_trace.h"
#include "sim/random.h"

namespace gazeloop::sim {
namespace {

double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

bool blinks(const gaze::GazeSample& sample) { return !sample.eyes[0].valid; }

/// The direction in world of the point that both eyes look at, from between them.
glm::dvec3 gaze_in_world(const gaze::GazeSample& sample, double distance_m) {
    // The left ray meets the sphere of that distance about the head's origin.
    const glm::dvec3& origin = sample.eyes[0].origin_m;
    const glm::dvec3& along = sample.eyes[0].direction;
    const double b = glm::dot(origin, along);
    const double c = glm::dot(origin, origin) - distance_m * distance_m;
    const double t = -b + std::sqrt(b * b - c);
    return sample.head->orientation * glm::normalize(origin + t * along);
}

struct Movement {
    double begin_s = 0.0;
    double duration_s = 0.0;
    double amplitude_deg = 0.0;
    double peak_deg_per_s = 0.0;
    glm::dvec3 landing_in_head{0.0};
};

struct Movements {
    std::vector<Movement> saccades;
    std::vector<double> fixations_s;
    std::vector<double> drifts_deg_per_s;
};

/// There is no noise, and no drift is faster than 1 deg/s: everything faster is a saccade.
/// Movements that a blink hides in part are left out.
Movements movements_of(const drivers::Trace& trace, const GazeGeneratorConfig& config) {
    constexpr double kDrift_deg_per_s = 1.0;
    Movements found;
    std::optional<bool> in_saccade;  // unknown after a blink
    bool complete = false;           // nothing of the present movement is hidden
    std::size_t begin = 0;
    double peak = 0.0;
    const auto gaze_at = [&](std::size_t i) {
        return gaze_in_world(trace.samples[i], config.distance_m);
    };
    for (std::size_t i = 0; i + 1 < trace.samples.size(); ++i) {
        if (blinks(trace.samples[i]) || blinks(trace.samples[i + 1])) {
            in_saccade.reset();
            complete = false;
            continue;
        }
        const double speed = angle_deg(gaze_at(i), gaze_at(i + 1)) * config.rate_hz;
        const bool fast = speed > kDrift_deg_per_s;
        if (!fast) {
            found.drifts_deg_per_s.push_back(speed);
        }
        if (!in_saccade) {
            in_saccade = fast;
        } else if (fast != *in_saccade) {
            const double duration_s = static_cast<double>(i - begin) / config.rate_hz;
            if (complete && *in_saccade) {
                const gaze::GazeSample& landed = trace.samples[i];
                found.saccades.push_back(
                    {.begin_s = static_cast<double>(begin) / config.rate_hz,
                     .duration_s = duration_s,
                     .amplitude_deg = angle_deg(gaze_at(begin), gaze_at(i)),
                     .peak_deg_per_s = peak,
                     .landing_in_head = glm::conjugate(landed.head->orientation) * gaze_at(i)});
            } else if (complete) {
                found.fixations_s.push_back(duration_s);
            }
            in_saccade = fast;
            complete = true;
            begin = i;
            peak = 0.0;
        }
        peak = std::max(peak, speed);
    }
    return found;
}

TEST(GazeGenerator, IsTheSameForTheSameSeedOnly) {
    const auto text = [](std::uint64_t seed) {
        std::ostringstream out;
        drivers::write_native_trace(generate_gaze({.seed = seed, .seconds = 5.0}), out);
        return out.str();
    };
    EXPECT_EQ(text(3), text(3));
    EXPECT_NE(text(3), text(4));
    EXPECT_NE(text(0), text(1));
}

TEST(GazeGenerator, GivesAPrefixForLessTime) {
    const drivers::Trace longer = generate_gaze({.seconds = 10.0});
    const drivers::Trace shorter = generate_gaze({.seconds = 4.0});
    ASSERT_EQ(shorter.samples.size(), 480U);
    ASSERT_EQ(longer.samples.size(), 1200U);
    EXPECT_EQ(shorter.samples.back().eyes[0].direction, longer.samples[479].eyes[0].direction);
}

TEST(GazeGenerator, TimesItsSamplesEvenly) {
    const drivers::Trace trace = generate_gaze({.seconds = 2.0, .rate_hz = 120.0});
    ASSERT_EQ(trace.samples.size(), 240U);
    for (std::size_t i = 0; i < trace.samples.size(); ++i) {
        EXPECT_EQ(trace.samples[i].sequence, i);
        EXPECT_EQ(trace.samples[i].sampled.kind, latency::StampKind::Modelled);
        EXPECT_EQ(trace.samples[i].sampled.ns, trace.samples[i].device_ns);
        EXPECT_NEAR(static_cast<double>(trace.samples[i].device_ns),
                    static_cast<double>(i) * 1e9 / 120.0, 0.5);
    }
    EXPECT_EQ(generate_gaze({.seconds = 1e-9}).samples.size(), 1U);
}

TEST(GazeGenerator, FollowsTheMainSequence) {
    const GazeGeneratorConfig config{.seed = 5, .seconds = 100.0, .rate_hz = 2000.0};
    const Movements found = movements_of(generate_gaze(config), config);
    ASSERT_GT(found.saccades.size(), 200U);
    double smallest = 90.0;
    double largest = 0.0;
    for (const Movement& saccade : found.saccades) {
        const double a = saccade.amplitude_deg;
        smallest = std::min(smallest, a);
        largest = std::max(largest, a);
        EXPECT_NEAR(saccade.peak_deg_per_s, 596.0 * (1.0 - std::exp(-a / 6.47)), 4.0) << a;
        // Its first and last moments are slower than the threshold.
        const double duration_ms = 2.2 * a + 21.0;
        EXPECT_LE(saccade.duration_s * 1e3, duration_ms + 1.0) << a;
        EXPECT_GE(saccade.duration_s * 1e3, duration_ms * 0.8) << a;
        EXPECT_LT(angle_deg(saccade.landing_in_head, {0.0, 0.0, -1.0}), 18.0 + 4.0) << a;
    }
    EXPECT_LT(smallest, 4.0);
    EXPECT_GT(largest, 20.0);
    EXPECT_NEAR(median(found.drifts_deg_per_s), 0.5, 0.1);
}

TEST(GazeGenerator, FixatesForAboutAQuarterOfASecond) {
    const GazeGeneratorConfig config{.seed = 6, .seconds = 400.0, .rate_hz = 250.0};
    const std::vector<double> durations = movements_of(generate_gaze(config), config).fixations_s;
    ASSERT_GT(durations.size(), 700U);
    // Long ones are hidden by blinks more often, and slow ends of saccades count as fixation.
    EXPECT_NEAR(median(durations), 0.224, 0.025);
    std::vector<double> logarithms;
    double sum = 0.0;
    for (const double duration : durations) {
        logarithms.push_back(std::log(duration));
        sum += logarithms.back();
    }
    const double mean = sum / static_cast<double>(logarithms.size());
    double squares = 0.0;
    for (const double logarithm : logarithms) {
        squares += (logarithm - mean) * (logarithm - mean);
    }
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(logarithms.size())), 0.45, 0.06);
    EXPECT_NEAR(std::exp(mean), median(durations), 0.02) << "not log-normal";
}

TEST(GazeGenerator, BlinksFifteenTimesAMinute) {
    const GazeGeneratorConfig config{.seed = 7, .seconds = 1200.0, .rate_hz = 100.0};
    const drivers::Trace trace = generate_gaze(config);
    std::vector<double> durations;
    std::size_t closed = 0;
    std::size_t blink = 0;
    for (const gaze::GazeSample& sample : trace.samples) {
        EXPECT_EQ(sample.eyes[0].valid, sample.eyes[1].valid);
        if (blinks(sample)) {
            EXPECT_LT(sample.eyes[0].confidence, 0.6);
            ++closed;
            ++blink;
        } else {
            EXPECT_EQ(sample.eyes[0].openness, 1.0);
            if (blink > 0) {
                durations.push_back(static_cast<double>(blink) / config.rate_hz);
            }
            blink = 0;
        }
    }
    const double per_minute = static_cast<double>(durations.size()) / (config.seconds / 60.0);
    EXPECT_NEAR(per_minute, 15.0, 2.0);
    EXPECT_NEAR(static_cast<double>(closed) / static_cast<double>(trace.samples.size()), 0.0625,
                0.01);
    const auto [shortest, longest] = std::minmax_element(durations.begin(), durations.end());
    EXPECT_GE(*shortest, 0.09);
    EXPECT_LE(*longest, 0.41);
    EXPECT_FALSE(blinks(trace.samples.front()));
}

TEST(GazeGenerator, CounterRotatesTheEyesWhileTheHeadTurns) {
    const GazeGeneratorConfig config{.seed = 8, .seconds = 60.0};
    const drivers::Trace trace = generate_gaze(config);
    const auto right_deg = [](const glm::dvec3& d) { return glm::degrees(std::atan2(d.x, -d.z)); };
    double products = 0.0;
    double fastest = 0.0;
    std::size_t fixating = 0;
    for (std::size_t i = 0; i + 1 < trace.samples.size(); ++i) {
        const gaze::GazeSample& a = trace.samples[i];
        const gaze::GazeSample& b = trace.samples[i + 1];
        if (blinks(a) || blinks(b)) {
            continue;
        }
        const double head = (right_deg(b.head->orientation * glm::dvec3{0.0, 0.0, -1.0}) -
                             right_deg(a.head->orientation * glm::dvec3{0.0, 0.0, -1.0})) *
                            config.rate_hz;
        fastest = std::max(fastest, std::abs(head));
        const double in_world =
            angle_deg(gaze_in_world(a, config.distance_m), gaze_in_world(b, config.distance_m)) *
            config.rate_hz;
        if (in_world > 1.0) {
            continue;
        }
        ++fixating;
        const double eye =
            (right_deg(b.eyes[0].direction) - right_deg(a.eyes[0].direction)) * config.rate_hz;
        products += eye * head;
        if (std::abs(head) > 5.0) {
            EXPECT_NEAR(eye, -head, 0.25 * std::abs(head) + 1.0);
        }
    }
    EXPECT_GT(fixating, trace.samples.size() / 2);
    EXPECT_LT(products, 0.0);
    EXPECT_GT(fastest, 20.0);
    EXPECT_LT(fastest, 60.0);
}

TEST(GazeGenerator, ConvergesAtTheDistance) {
    const drivers::Trace trace = generate_gaze({.seed = 9, .seconds = 20.0, .distance_m = 0.5});
    for (const gaze::GazeSample& sample : trace.samples) {
        if (blinks(sample)) {
            continue;
        }
        const gaze::EyeRay& left = sample.eyes[0];
        const gaze::EyeRay& right = sample.eyes[1];
        EXPECT_DOUBLE_EQ(left.origin_m.x, -0.0315);
        EXPECT_DOUBLE_EQ(right.origin_m.x, 0.0315);
        EXPECT_NEAR(glm::length(left.direction), 1.0, 1e-12);
        // Both rays pass through one point at the distance from the head's origin.
        const glm::dvec3 point =
            glm::conjugate(sample.head->orientation) * gaze_in_world(sample, 0.5) * 0.5;
        EXPECT_NEAR(angle_deg(right.direction, point - right.origin_m), 0.0, 1e-6);
        EXPECT_GT(left.direction.x / -left.direction.z, right.direction.x / -right.direction.z);
    }
}

TEST(Random, GivesTheSameNumbersEverywhere) {
    // Worked out by another implementation of SplitMix64.
    Random random(1, 1);
    EXPECT_EQ(random.uniform(), 0x1.1d3fb5ae96aa8p-3);
    EXPECT_EQ(random.uniform(), 0x1.ef87bb02a598ap-2);
    EXPECT_EQ(random.uniform(), 0x1.3c1c2a575deacp-1);
    EXPECT_NE(Random(1, 2).uniform(), Random(1, 1).uniform());
}

TEST(Random, HasTheDistributionsItSays) {
    Random random(42, 0);
    constexpr int kDraws = 200'000;
    double sum = 0.0;
    double squares = 0.0;
    double uniforms = 0.0;
    double exponentials = 0.0;
    int below_median = 0;
    for (int i = 0; i < kDraws; ++i) {
        const double normal = random.normal();
        sum += normal;
        squares += normal * normal;
        const double uniform = random.uniform(2.0, 4.0);
        EXPECT_TRUE(uniform >= 2.0 && uniform < 4.0);
        uniforms += uniform;
        exponentials += random.exponential(3.0);
        below_median += random.log_normal(0.224, 0.45) < 0.224 ? 1 : 0;
    }
    EXPECT_NEAR(sum / kDraws, 0.0, 0.01);
    EXPECT_NEAR(squares / kDraws, 1.0, 0.02);
    EXPECT_NEAR(uniforms / kDraws, 3.0, 0.01);
    EXPECT_NEAR(exponentials / kDraws, 3.0, 0.04);
    EXPECT_NEAR(static_cast<double>(below_median) / kDraws, 0.5, 0.01);
}

}  // namespace
}  // namespace gazeloop::sim
