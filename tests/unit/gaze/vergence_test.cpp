#include "runtime/gaze/vergence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/gaze/painted_depth.h"

namespace gazeloop::gaze {
namespace {

constexpr std::int64_t kFrame_ns = 14'000'000;
constexpr double kAssumed = 1.0 / 1.5;

class VergenceTest : public testing::Test {
  protected:
    double follow(std::optional<double> found, double right_deg = 0.0) {
        now_ns_ += kFrame_ns;
        return vergence_.follow(found, kAssumed, towards_deg(right_deg, 0.0), now_ns_);
    }

    Vergence vergence_;
    std::int64_t now_ns_ = 0;
};

TEST_F(VergenceTest, TakesWhatIsFoundFirst) {
    EXPECT_EQ(follow(std::nullopt), kAssumed);
    EXPECT_EQ(follow(std::nullopt), kAssumed);
    EXPECT_EQ(follow(2.5), 2.5);
}

TEST_F(VergenceTest, FollowsWithItsTimeConstant) {
    follow(0.5);
    const double frames = Vergence::kTimeConstant_s * 1e9 / kFrame_ns;
    double nearness = 0.5;
    double before = 0.5;
    for (int i = 1; i < 60; ++i) {
        nearness = follow(2.5);
        EXPECT_GE(nearness, before);
        EXPECT_NEAR(nearness, 2.5 - 2.0 * std::exp(-i / frames), 1e-9);
        before = nearness;
    }
    EXPECT_NEAR(nearness, 2.5, 1e-3);
}

// A tracker whose noise throws the gaze over an edge with every sample: 1.83 dioptres, 3.3 degrees
// an eye. The foveae come to lie in between and move by a few tenths of a degree.
TEST_F(VergenceTest, DoesNotJumpWithANoisyGazeAtAnEdge) {
    double nearness = follow(2.5);
    double largest_step = 0.0;
    for (int i = 0; i < 200; ++i) {
        const double next = follow(i % 2 == 0 ? kAssumed : 2.5, i % 2 == 0 ? 0.3 : 0.0);
        if (i > 50) {
            largest_step = std::max(largest_step, std::abs(next - nearness));
            EXPECT_NEAR(next, (2.5 + kAssumed) / 2.0, 0.15);
        }
        nearness = next;
    }
    EXPECT_LT(largest_step * kHalfBetweenEyes_m, 0.0052) << "0.3 degrees";
}

TEST_F(VergenceTest, JumpsWithTheGaze) {
    follow(0.5);
    EXPECT_EQ(follow(2.5, 4.0), 2.5);
    EXPECT_EQ(follow(std::nullopt, 12.0), kAssumed) << "nothing is seen there yet";
    EXPECT_EQ(follow(3.0, 12.1), 3.0);
    EXPECT_LT(follow(0.5, 13.0), 3.0);
    EXPECT_GT(follow(0.5, 13.0), 1.5) << "no jump";
}

TEST_F(VergenceTest, BeginsAnewAfterAGapAndWhenTimeGoesBack) {
    follow(0.5);
    now_ns_ += Vergence::kGap_ns;
    EXPECT_EQ(follow(2.5), 2.5);
    now_ns_ -= 10 * kFrame_ns;
    EXPECT_EQ(follow(1.0), 1.0);
    vergence_.forget();
    EXPECT_EQ(follow(2.0), 2.0);
    now_ns_ = std::numeric_limits<std::int64_t>::max() - kFrame_ns;
    EXPECT_EQ(follow(3.0), 3.0);
    EXPECT_EQ(vergence_.follow(1.0, kAssumed, towards_deg(0.0, 0.0),
                               std::numeric_limits<std::int64_t>::min()),
              1.0);
}

TEST_F(VergenceTest, GoesBackSlowlyToWhatIsAssumed) {
    follow(2.5);
    EXPECT_GT(follow(std::nullopt), 2.0);
    for (int i = 0; i < 100; ++i) {
        follow(std::nullopt);
    }
    EXPECT_NEAR(follow(std::nullopt), kAssumed, 1e-6);
}

}  // namespace
}  // namespace gazeloop::gaze
