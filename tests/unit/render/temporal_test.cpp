// What follows motion from frame to frame, before a method uses it.
#include <gtest/gtest.h>

#include <set>

#include "runtime/render/jitter.h"
#include "runtime/render/last_views.h"

namespace gazeloop::render {
namespace {

gaze::StereoView views_at(double x_m) {
    gaze::StereoView views;
    for (gaze::EyeView& view : views) {
        view = {.pose = {.position_m = {x_m, 0, 0}},
                .fov = {-0.8, 0.8, 0.7, -0.7},
                .width_px = 64,
                .height_px = 48};
    }
    return views;
}

TEST(LastViews, AreThoseOfTheFrameBefore) {
    LastViews last;
    EXPECT_FALSE(last.begin(0, views_at(0)));
    EXPECT_EQ(last.of(gaze::Eye::Left), nullptr);
    EXPECT_TRUE(last.begin(1, views_at(1)));
    ASSERT_NE(last.of(gaze::Eye::Right), nullptr);
    EXPECT_EQ(last.of(gaze::Eye::Right)->pose.position_m.x, 0.0);
    EXPECT_TRUE(last.begin(2, views_at(2)));
    EXPECT_EQ(last.of(gaze::Eye::Left)->pose.position_m.x, 1.0);
}

TEST(LastViews, BeginAnewWhereNothingFitsAnyMore) {
    LastViews last;
    last.begin(0, views_at(0));
    EXPECT_FALSE(last.begin(2, views_at(0))) << "a frame was left out";
    EXPECT_TRUE(last.begin(3, views_at(0)));
    gaze::StereoView wider = views_at(0);
    wider[1].fov.right_rad = 0.9;
    EXPECT_FALSE(last.begin(4, wider)) << "another field of view";
    gaze::StereoView larger = wider;
    larger[0].width_px = 65;
    EXPECT_FALSE(last.begin(5, larger)) << "another size";
    EXPECT_TRUE(last.begin(6, larger));
    EXPECT_FALSE(last.begin(0, larger)) << "a replay begins again";
}

TEST(Jitter, CoversTheCellEvenlyAndBeginsAnew) {
    Jitter jitter;
    const glm::dvec2 first = jitter.offset();
    glm::dvec2 sum(0.0);
    std::set<double> across;
    for (std::uint32_t phase = 0; phase < Jitter::kPhases; ++phase) {
        const glm::dvec2 at = jitter.offset();
        EXPECT_LT(std::abs(at.x), 0.5);
        EXPECT_LT(std::abs(at.y), 0.5);
        across.insert(at.x);
        sum += at;
        jitter.advance();
    }
    EXPECT_EQ(across.size(), Jitter::kPhases);
    EXPECT_NEAR(sum.x, 0.0, 1e-12);
    EXPECT_NEAR(sum.y, 0.0, 1e-12);
    EXPECT_EQ(jitter.offset(), first) << "after a whole period";
    jitter.advance();
    jitter.reset();
    EXPECT_EQ(jitter.offset(), first);
}

}  // namespace
}  // namespace gazeloop::render
