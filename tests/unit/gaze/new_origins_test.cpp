#include "runtime/gaze/new_origins.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "runtime/gaze/head_limits.h"
#include "runtime/gaze/origin_change.h"

namespace gazeloop::gaze {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t k120Hz_ns = 8'333'333;

Pose yawed(double degrees, const glm::dvec3& position_m = {0.1, 1.6, 0.0}) {
    return {glm::angleAxis(glm::radians(degrees), glm::dvec3{0.0, 1.0, 0.0}), position_m};
}

using HeadAt = std::function<std::optional<Pose>(std::size_t)>;

std::vector<GazeSample> samples_of(std::size_t count, std::int64_t interval_ns,
                                   const HeadAt& head) {
    std::vector<GazeSample> samples(count);
    for (std::size_t i = 0; i < count; ++i) {
        samples[i].sampled = {static_cast<std::int64_t>(i) * interval_ns,
                              time::StampKind::Modelled};
        samples[i].head = head(i);
    }
    return samples;
}

/// What a clock that counts in such steps makes of the times.
std::vector<GazeSample> coarse(std::vector<GazeSample> samples, std::int64_t step_ns) {
    for (GazeSample& sample : samples) {
        sample.sampled.ns -= sample.sampled.ns % step_ns;
    }
    return samples;
}

std::vector<std::size_t> places(const std::vector<GazeSample>& samples) {
    std::vector<std::size_t> found;
    for (const NewOrigin& origin : new_origins(samples)) {
        found.push_back(origin.sample);
    }
    return found;
}

TEST(NewOrigins, AreWhereTheHeadTurnsAsNoHeadTurns) {
    const auto samples =
        samples_of(600, k120Hz_ns, [](std::size_t i) { return yawed(i < 300 ? 5.0 : 95.0); });
    const std::vector<NewOrigin> origins = new_origins(samples);
    ASSERT_EQ(origins.size(), 1U);
    EXPECT_EQ(origins[0].sample, 300U);
    EXPECT_EQ(origins[0].time_ns, 300 * k120Hz_ns);
    EXPECT_EQ(origins[0].interval_ns, k120Hz_ns);
    EXPECT_NEAR(glm::degrees(origins[0].turned_rad), 90.0, 1e-9);
    EXPECT_NEAR(origins[0].moved_m, 0.0, 1e-12);
    // The new pose, in the world before, is the one before.
    const Pose same = compose(origins[0].new_in_old, *samples[300].head);
    EXPECT_NEAR(turned_rad(same, *samples[299].head), 0.0, 1e-9);
    EXPECT_NEAR(moved_m(same, *samples[299].head), 0.0, 1e-12);
}

TEST(NewOrigins, AreWhereTheHeadMovesAsNoHeadMoves) {
    // 5 m/s are 41.7 mm in an interval.
    const auto moved_by = [](double m) {
        return places(samples_of(100, k120Hz_ns, [m](std::size_t i) {
            return yawed(0.0, {0.0, i < 50 ? 0.0 : m, 0.0});
        }));
    };
    EXPECT_THAT(moved_by(0.041), IsEmpty());
    EXPECT_THAT(moved_by(0.042), ElementsAre(50U));
    // 1500 deg/s are 12.5 degrees.
    const auto turned_by = [](double degrees) {
        return places(samples_of(100, k120Hz_ns, [degrees](std::size_t i) {
            return yawed(i < 50 ? 170.0 : 170.0 + degrees);
        }));
    };
    EXPECT_THAT(turned_by(12.4), IsEmpty());
    EXPECT_THAT(turned_by(12.6), ElementsAre(50U));
    EXPECT_THAT(turned_by(-12.6), ElementsAre(50U));
}

TEST(NewOrigins, AreNotWhereAHeadTurnsFast) {
    EXPECT_THAT(places(samples_of(200, k120Hz_ns,
                                  [](std::size_t i) {
                                      const double s = static_cast<double>(i) / 120.0;
                                      return yawed(100.0 * std::sin(8.0 * s));  // 800 deg/s
                                  })),
                IsEmpty());
}

TEST(NewOrigins, MayFollowOneAnother) {
    EXPECT_THAT(places(samples_of(20, k120Hz_ns,
                                  [](std::size_t i) {
                                      return yawed(i < 10 ? 0.0 : i == 10 ? 90.0 : -60.0);
                                  })),
                ElementsAre(10U, 11U));
}

TEST(NewOrigins, AreFoundInCoarseTimesAndNotBecauseOfThem) {
    // 2000 Hz in whole milliseconds: every time twice. 300 deg/s are .15 deg in no time.
    const auto turning = [](std::size_t i) { return yawed(0.15 * static_cast<double>(i)); };
    EXPECT_THAT(places(coarse(samples_of(800, 500'000, turning), kMs)), IsEmpty());
    const auto jumping = [](std::size_t i) {
        return yawed(0.15 * static_cast<double>(i) + (i < 401 ? 0.0 : 90.0));
    };
    EXPECT_THAT(places(coarse(samples_of(800, 500'000, jumping), kMs)), ElementsAre(401U));
    // 120 Hz by a clock that ticks every 15.6 ms.
    const auto slow_clock = [](std::size_t i) {
        return yawed(2.0 * static_cast<double>(i) + (i < 201 ? 0.0 : 90.0));
    };
    EXPECT_THAT(places(coarse(samples_of(400, k120Hz_ns, slow_clock), 15'600'000)),
                ElementsAre(201U));
}

TEST(NewOrigins, AreNotWhereARepeatedPoseIsRenewed) {
    // 1000 Hz with a head at 90 Hz and 300 deg/s: 3.3 degrees within 1 ms.
    const auto renewed = [](std::size_t i) {
        return 300.0 / 90.0 * std::floor(static_cast<double>(i) * 0.09);
    };
    EXPECT_THAT(places(samples_of(1000, kMs, [&](std::size_t i) { return yawed(renewed(i)); })),
                IsEmpty());
    EXPECT_THAT(
        places(samples_of(
            1000, kMs, [&](std::size_t i) { return yawed(renewed(i) + (i < 500 ? 0.0 : 90.0)); })),
        ElementsAre(500U));
}

TEST(NewOrigins, OfAHeadThatRestsAreAllFound) {
    EXPECT_THAT(
        places(samples_of(1000, k120Hz_ns,
                          [](std::size_t i) {
                              return yawed(40.0 * std::floor(static_cast<double>(i) / 240.0));
                          })),
        ElementsAre(240U, 480U, 720U, 960U));
}

TEST(NewOrigins, TakeTheTimeThatAPoseWasUnknownForTimeToTurn) {
    const auto unknown_for = [](std::size_t rows) {
        return places(samples_of(400, k120Hz_ns, [rows](std::size_t i) -> std::optional<Pose> {
            if (i >= 100 && i < 100 + rows) {
                return std::nullopt;
            }
            return yawed(i < 100 ? 0.0 : 90.0);
        }));
    };
    EXPECT_THAT(unknown_for(2), ElementsAre(102U));
    EXPECT_THAT(unknown_for(120), IsEmpty());
}

TEST(NewOrigins, NeedTwoUsablePoses) {
    EXPECT_THAT(places({}), IsEmpty());
    EXPECT_THAT(places(samples_of(50, k120Hz_ns, [](std::size_t) { return std::nullopt; })),
                IsEmpty());
    EXPECT_THAT(places(samples_of(50, k120Hz_ns,
                                  [](std::size_t i) -> std::optional<Pose> {
                                      return i == 7 ? std::optional(yawed(70.0)) : std::nullopt;
                                  })),
                IsEmpty());
    // What is no pose says nothing of the origin.
    EXPECT_THAT(places(samples_of(50, k120Hz_ns,
                                  [](std::size_t i) {
                                      const double nan = std::numeric_limits<double>::quiet_NaN();
                                      return i == 7   ? Pose{{0.0, 0.0, 0.0, 0.0}, {}}
                                             : i == 9 ? yawed(0.0, {nan, 0.0, 0.0})
                                                      : yawed(0.0);
                                  })),
                IsEmpty());
}

TEST(NewOrigins, PassOverPosesWhoseTimeGoesBack) {
    auto samples = samples_of(50, k120Hz_ns, [](std::size_t) { return yawed(0.0); });
    samples[20].sampled.ns = 0;
    samples[20].head = yawed(90.0);
    EXPECT_THAT(places(samples), IsEmpty());
}

TEST(NewOrigins, StandTimesThatSpanAll) {
    auto samples = samples_of(3, 1, [](std::size_t i) { return yawed(i == 2 ? 90.0 : 0.0); });
    samples[0].sampled.ns = std::numeric_limits<std::int64_t>::min();
    samples[2].sampled.ns = std::numeric_limits<std::int64_t>::max();
    EXPECT_THAT(places(samples), IsEmpty());
}

TEST(NewOrigins, AreReportedWithTimeAndSize) {
    TraceReport report;
    report_new_origins(samples_of(600, k120Hz_ns,
                                  [](std::size_t i) {
                                      return yawed(i < 300 ? 5.0 : 95.0,
                                                   {0.0, i < 300 ? 1.6 : 1.35, 0.0});
                                  }),
                       report);
    ASSERT_EQ(report.findings().size(), 1U);
    EXPECT_EQ(report.findings()[0].kind, TraceFindingKind::NewOrigin);
    EXPECT_THAT(report.findings()[0].text,
                HasSubstr("at 2.500 s the head turns by 90.0 deg and moves by 0.250 m in 8.3 ms"));
    EXPECT_EQ(report.count(TraceFindingKind::NewOrigin).times, 1U);
    EXPECT_EQ(report.count(TraceFindingKind::NewOrigin).rows, 1U);
    EXPECT_EQ(report.rows_dropped(), 0U);
}

}  // namespace
}  // namespace gazeloop::gaze
