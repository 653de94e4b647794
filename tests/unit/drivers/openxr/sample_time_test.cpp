#include "drivers/openxr/sample_time.h"

#include <gtest/gtest.h>

#include <limits>
#include <utility>

namespace gazeloop::drivers {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kNow = 1'000'000 * kMs;
constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
/// The runtime's time line may be any other than the host's.
constexpr std::int64_t kOffset = 77'000 * kMs;

GivenTime at(std::int64_t host_ns) {
    return {
        .given = host_ns + kOffset, .host_ns = host_ns, .asked = kNow + kOffset, .now_ns = kNow};
}

TEST(SampleTime, IsMeasuredWhereTheRuntimeSaysIt) {
    for (const std::int64_t age_ns : {std::int64_t{1}, 8 * kMs, 9'000 * kMs}) {
        const auto time = sample_time(at(kNow - age_ns));
        EXPECT_EQ(time.trouble, SampleTimeTrouble::None);
        EXPECT_EQ(time.sampled, (time::Stamp{kNow - age_ns, time::StampKind::Measured}));
        EXPECT_EQ(time.pose_ns, kNow - age_ns);
    }
}

TEST(SampleTime, IsUnknownAtZeroAndNeverZero) {
    const auto time = sample_time({.given = 0, .host_ns = {}, .asked = kNow, .now_ns = kNow});
    EXPECT_EQ(time.trouble, SampleTimeTrouble::NotGiven);
    EXPECT_FALSE(time.sampled.known());
    EXPECT_FALSE(time.pose_ns.has_value());
}

// The pose is for then; when the eye was seen nobody says.
TEST(SampleTime, IsUnknownWhereThePoseIsPredicted) {
    const auto asked = sample_time(at(kNow));
    EXPECT_EQ(asked.trouble, SampleTimeTrouble::Predicted);
    EXPECT_FALSE(asked.sampled.known());
    EXPECT_EQ(asked.pose_ns, kNow);
    const auto ahead = sample_time(at(kNow + 10 * kMs));
    EXPECT_EQ(ahead.trouble, SampleTimeTrouble::Ahead);
    EXPECT_FALSE(ahead.sampled.known());
    EXPECT_EQ(ahead.pose_ns, kNow + 10 * kMs);
}

TEST(SampleTime, AllowsForTheNoiseOfTwoClocks) {
    EXPECT_EQ(sample_time(at(kNow + kClockNoise_ns)).trouble, SampleTimeTrouble::None);
    EXPECT_EQ(sample_time(at(kNow + kClockNoise_ns + 1)).trouble, SampleTimeTrouble::Ahead);
}

// The time base is another one's: the gaze itself is as good as any.
TEST(SampleTime, IsUnknownWhereItIsAbsurd) {
    const auto expect_absurd = [](const GivenTime& given) {
        const SampleTime time = sample_time(given);
        EXPECT_EQ(time.trouble, SampleTimeTrouble::Absurd) << given.given;
        EXPECT_FALSE(time.sampled.known());
        EXPECT_FALSE(time.pose_ns.has_value());
    };
    expect_absurd(at(kNow + kFarthestSample_ns + 1));
    expect_absurd(at(kNow - kFarthestSample_ns - 1));
    EXPECT_EQ(sample_time(at(kNow - kFarthestSample_ns)).trouble, SampleTimeTrouble::None);
    expect_absurd({.given = 5, .host_ns = {}, .asked = kNow, .now_ns = kNow});
    for (const std::int64_t given : {std::int64_t{-1}, -kMost - 1}) {
        expect_absurd({.given = given, .host_ns = kNow, .asked = kNow, .now_ns = kNow});
    }
    for (const auto& [host_ns, now_ns] :
         {std::pair{kMost, -kMost - 1}, std::pair{-kMost - 1, kMost}}) {
        expect_absurd({.given = 5, .host_ns = host_ns, .asked = 9, .now_ns = now_ns});
    }
}

TEST(SampleTime, IsExplained) {
    for (const SampleTimeTrouble trouble :
         {SampleTimeTrouble::None, SampleTimeTrouble::NotGiven, SampleTimeTrouble::Predicted,
          SampleTimeTrouble::Ahead, SampleTimeTrouble::StandsStill, SampleTimeTrouble::Absurd}) {
        EXPECT_FALSE(text_of(trouble).empty());
    }
}

}  // namespace
}  // namespace gazeloop::drivers
