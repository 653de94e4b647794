// Which views a lens that moves will ask for next.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <vector>

#include "runtime/light_field/likely_views.h"
#include "runtime/light_field/resident_views.h"

namespace gazeloop::light_field {
namespace {

using List = std::vector<std::uint32_t>;

constexpr double kSpacing_m = 0.005;
const LightField kField{.cameras = {.columns = 25, .rows = 25, .spacing_m = kSpacing_m},
                        .lens = {.aperture_m = 0.0125}};

List after(const LightField& field, const std::vector<MovingLens>& lenses) {
    LikelyViews likely(field);
    const auto views = likely.after(lenses);
    return {views.begin(), views.end()};
}

std::set<std::uint32_t> asked_at(const LightField& field, const glm::dvec2& middle_m) {
    std::set<std::uint32_t> views;
    ViewsInLens(field, {middle_m, 0.0}).for_each([&](const WeightedView& view) {
        views.insert(view.view);
    });
    return views;
}

double distance_m(const LightField& field, std::uint32_t view, const glm::dvec2& from_m) {
    return glm::distance(field.cameras.camera_m(view % 25, view / 25), from_m);
}

// As it goes on, it finds all that it asks for, however it came, and the next frames' first.
TEST(LikelyViews, AreWhatAMovingLensAsksForNext) {
    for (const glm::dvec2& step_m :
         {glm::dvec2{0.0025, 0.0}, glm::dvec2{-0.001, 0.0008}, glm::dvec2{0.0, -0.004}}) {
        const glm::dvec2 middle_m{0.0013, -0.0007};
        const List likely = after(kField, {{middle_m, step_m}});
        const auto now = asked_at(kField, middle_m);
        std::set<std::uint32_t> within;
        for (int frame = 1; frame <= 10; ++frame) {
            std::set<std::uint32_t> fresh;
            for (const std::uint32_t view :
                 asked_at(kField, middle_m + static_cast<double>(frame) * step_m)) {
                if (!now.contains(view)) {
                    fresh.insert(view);
                    ASSERT_TRUE(std::ranges::find(likely, view) != likely.end()) << frame;
                }
            }
            within.insert(fresh.begin(), fresh.end());
            if (frame == 1) {
                // What it might ask for if it turned aside may stand among them, no more.
                for (const std::uint32_t view : fresh) {
                    const auto place = std::ranges::find(likely, view) - likely.begin();
                    EXPECT_LT(static_cast<std::size_t>(place), 2 * fresh.size() + 4);
                }
            }
        }
        EXPECT_FALSE(within.empty());
        for (const std::uint32_t view : now) {
            EXPECT_TRUE(std::ranges::find(likely, view) == likely.end()) << "it has these";
        }
        // Nothing behind it.
        for (const std::uint32_t view : likely) {
            const glm::dvec2 apart = kField.cameras.camera_m(view % 25, view / 25) - middle_m;
            EXPECT_GT(glm::dot(apart, step_m), -glm::length(apart) * glm::length(step_m));
        }
    }
}

TEST(LikelyViews, OfALensThatStandsLieAroundItTheNearestFirst) {
    const glm::dvec2 middle_m{0.0, 0.0};
    const List likely = after(kField, {{middle_m, {}}});
    double before_m = reach_m(kField);
    std::size_t above = 0;
    for (const std::uint32_t view : likely) {
        const double apart_m = distance_m(kField, view, middle_m);
        EXPECT_GE(apart_m, before_m - 1e-12);
        EXPECT_LE(apart_m, reach_m(kField) + kSpacing_m + 1e-12);
        before_m = apart_m;
        above += view / 25 < 12 ? 1 : 0;
    }
    EXPECT_GT(above, likely.size() / 3);
    std::size_t expected = 0;
    for (std::uint32_t view = 0; view < 625; ++view) {
        const double apart_m = distance_m(kField, view, middle_m);
        expected += apart_m >= reach_m(kField) && apart_m < reach_m(kField) + kSpacing_m ? 1 : 0;
    }
    EXPECT_EQ(likely.size(), expected);
    EXPECT_EQ(after(kField, {{middle_m, {5.0, 0.0}}}), likely) << "a jump says nothing";
}

TEST(LikelyViews, OfAMovingLensLieBeforeItFirst) {
    const List likely = after(kField, {{{0.0, 0.0}, {0.002, 0.0}}});
    ASSERT_GE(likely.size(), 10U);
    for (const std::uint32_t view : std::span(likely).first(5)) {
        EXPECT_GT(view % 25, 12U) << "to the right";
    }
}

// Cameras end at the rim: beyond it there is nothing to fetch.
TEST(LikelyViews, EndWhereTheCamerasDo) {
    const glm::dvec2 rim_m = kField.cameras.half_extent_m();
    for (const std::uint32_t view : after(kField, {{rim_m, {0.002, 0.002}}})) {
        EXPECT_LT(view, 625U);
    }
    const LightField one{.cameras = {}, .lens = {.aperture_m = 0.0}};
    EXPECT_EQ(after(one, {{{}, {0.001, 0.0}}}), List{});
}

// What either eye's lens has is not likely; each view is there once.
TEST(LikelyViews, OfTwoLensesAreThoseOfBoth) {
    const MovingLens left{{-0.0315, 0.0}, {0.001, 0.0}};
    const MovingLens right{{0.0315, 0.0}, {0.001, 0.0}};
    const List both = after(kField, {left, right});
    const std::set<std::uint32_t> once(both.begin(), both.end());
    EXPECT_EQ(once.size(), both.size());
    for (const MovingLens& lens : {left, right}) {
        for (const std::uint32_t view : asked_at(kField, lens.middle_m)) {
            EXPECT_FALSE(once.contains(view));
        }
        const List alone = after(kField, {lens});
        EXPECT_TRUE(once.contains(alone.front()));
    }
}

/// Of 900 frames at 90 Hz, those that wait for views: two eyes before lenses of 10 mm sway by
/// `fast_m_s` at most, within as many views at a time as 400 MiB hold of 1024 x 1024 px. `ahead`
/// are fetched a frame, and have their room in those 400 MiB, twice.
std::uint32_t waiting_frames(double fast_m_s, std::uint32_t ahead) {
    const LightField field{.cameras = kField.cameras, .lens = {.aperture_m = 0.01}};
    ResidentViews resident(field.cameras.count(), 96 - ahead);
    LikelyViews likely(field);
    std::uint32_t waiting = 0;
    std::vector<MovingLens> lenses;
    for (int frame = 0; frame <= 900; ++frame) {
        constexpr double kSway_m = 0.04;
        const double phase = fast_m_s / kSway_m * frame / 90.0;
        const glm::dvec3 head_m{kSway_m * std::sin(phase),
                                0.6 * kSway_m * std::sin(0.7 * phase + 1.0), 0.0};
        const std::vector<MovingLens> before = lenses;
        lenses.clear();
        List wanted;
        for (const double eye_m : {-0.0315, 0.0315}) {
            const ViewsInLens lens(field, head_m + glm::dvec3{eye_m, 0.0, 0.0});
            lens.for_each([&](const WeightedView& view) { wanted.push_back(view.view); });
            const std::size_t e = lenses.size();
            lenses.push_back({lens.middle_m(), before.empty()
                                                   ? glm::dvec2(0.0)
                                                   : lens.middle_m() - before[e].middle_m});
        }
        const bool waits = !resident.request(wanted).empty();
        waiting += frame > 0 && waits ? 1 : 0;  // the first one has nothing
        (void)resident.fetch_ahead(likely.after(lenses), ahead);
    }
    return waiting;
}

TEST(LikelyViews, SpareFramesTheirWaits) {
    EXPECT_GT(waiting_frames(0.05, 0), 400U);
    EXPECT_EQ(waiting_frames(0.05, 12), 0U);
    EXPECT_GT(waiting_frames(0.2, 0), 700U);
    EXPECT_LT(waiting_frames(0.2, 12), 9U);
    EXPECT_GT(waiting_frames(0.4, 0), 800U);
    EXPECT_LT(waiting_frames(0.4, 12), 45U);
    EXPECT_GT(waiting_frames(0.4, 8), 90U);
}

// A camera whose whole spacing is rounded to a little less is no view of the lens, but a likely
// one.
TEST(LikelyViews, OfALensOverACameraAreItsNeighbours) {
    const LightField closed{.cameras = {.columns = 25, .rows = 25, .spacing_m = kSpacing_m},
                            .lens = {.aperture_m = 0.0}};
    for (int column = 1; column < 24; ++column) {
        const List likely =
            after(closed, {{closed.cameras.camera_m(static_cast<std::uint32_t>(column), 7), {}}});
        ASSERT_GE(likely.size(), 4U);
        const auto at = static_cast<std::uint32_t>(7 * 25 + column);
        const std::set<std::uint32_t> nearest(likely.begin(), likely.begin() + 4);
        EXPECT_EQ(nearest, (std::set<std::uint32_t>{at - 25, at - 1, at + 1, at + 25}));
    }
}

}  // namespace
}  // namespace gazeloop::light_field
