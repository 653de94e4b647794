// What antialiasing decides on the CPU.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "runtime/render/post_filter.h"
#include "runtime/render/saccade_landing.h"

namespace gazeloop::render {
namespace {

TEST(PostFilter, GrowsByTwoPixelsEveryTwentiethOfTheWay) {
    // Meng et al. 2018, Eq. 14, with its brackets read as floor.
    for (const auto& [share, size] : {std::pair{0.0, 1U},
                                      {0.05, 1U},
                                      {0.0999, 1U},
                                      {0.10, 3U},
                                      {0.149, 3U},
                                      {0.15, 5U},
                                      {0.20, 7U},
                                      {0.30, 11U},
                                      {0.5, 19U},
                                      {0.97, 37U},
                                      {1.0, 39U},
                                      {7.0, 39U}}) {
        EXPECT_EQ(post_filter_size(share, 39), size) << share;
    }
    // Steps in float and in double are the same: shares a hair below count as on them.
    for (int step = 0; step <= 18; ++step) {
        const double share = 0.10 + 0.05 * step;
        EXPECT_EQ(post_filter_size(static_cast<float>(share), 39),
                  3U + 2U * static_cast<unsigned>(step));
    }
}

TEST(PostFilter, IsOddAndNoLargerThanAskedFor) {
    EXPECT_EQ(largest_post_filter(0), 1U);
    EXPECT_EQ(largest_post_filter(2), 1U);
    EXPECT_EQ(largest_post_filter(3), 3U);
    EXPECT_EQ(largest_post_filter(8), 7U);
    EXPECT_EQ(largest_post_filter(39), 39U);
    EXPECT_EQ(post_filter_size(0.9, 7), 7U);
    EXPECT_EQ(post_filter_size(0.12, 7), 3U);
    EXPECT_EQ(post_filter_size(-1.0, 7), 1U);
    EXPECT_EQ(post_filter_size(std::numeric_limits<double>::quiet_NaN(), 7), 1U);
    EXPECT_EQ(post_filter_size(std::numeric_limits<double>::infinity(), 7), 7U);
}

class SaccadeLandingTest : public testing::Test {
  protected:
    bool looks(double gaze_deg, double head_deg = 0.0,
               std::optional<gaze::EyeEvent> event = std::nullopt) {
        const auto rad = [](double deg) { return deg * std::numbers::pi / 180.0; };
        gaze::FoveaPoint fovea;
        fovea.direction = {std::sin(rad(gaze_deg)), 0.0, -std::cos(rad(gaze_deg))};
        fovea.event = event;
        const gaze::Pose eye{.orientation = glm::angleAxis(-rad(head_deg), glm::dvec3(0, 1, 0))};
        return landing_.landed(fovea, eye);
    }
    SaccadeLanding landing_;
};

TEST_F(SaccadeLandingTest, IsTheFirstSlowFrameAfterFastOnes) {
    EXPECT_FALSE(looks(0.0));
    EXPECT_FALSE(looks(0.3)) << "drift and noise";
    EXPECT_FALSE(looks(4.0));
    EXPECT_FALSE(looks(9.0));
    EXPECT_FALSE(looks(10.0)) << "slower, but still under way";
    EXPECT_TRUE(looks(10.2));
    EXPECT_FALSE(looks(10.3));
}

TEST_F(SaccadeLandingTest, TakesNoTurningHeadForASaccade) {
    // The head turns by 3 degrees a frame and the eyes turn against it; then they turn with it.
    for (int frame = 0; frame < 5; ++frame) {
        EXPECT_FALSE(looks(-3.0 * frame, 3.0 * frame));
    }
    landing_.reset();
    for (int frame = 0; frame < 5; ++frame) {
        EXPECT_FALSE(looks(0.0, 3.0 * frame));
    }
}

TEST_F(SaccadeLandingTest, BelievesTheEventsOfTheGaze) {
    using enum gaze::EyeEvent;
    EXPECT_FALSE(looks(0.0, 0.0, Fixation));
    EXPECT_FALSE(looks(5.0, 0.0, Fixation)) << "a jump of the tracker's";
    EXPECT_FALSE(looks(5.5, 0.0, Saccade));
    EXPECT_TRUE(looks(5.6, 0.0, Oscillation));
    EXPECT_FALSE(looks(5.6, 0.0, Fixation));
}

}  // namespace
}  // namespace gazeloop::render
