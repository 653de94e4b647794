// The lens that a light field is seen through: which views it takes, and how much of each.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "runtime/light_field/lens.h"

namespace gazeloop::light_field {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kFar = std::numeric_limits<double>::infinity();

std::vector<WeightedView> views_of(const LightField& field, const glm::dvec3& eye_m) {
    std::vector<WeightedView> views;
    ViewsInLens(field, eye_m).for_each([&](const WeightedView& view) { views.push_back(view); });
    return views;
}

const std::array kEyes_m{glm::dvec3{0.0}, glm::dvec3{0.0315, 0.004, 0.2},
                         glm::dvec3{0.05, -0.05, 0.0}, glm::dvec3{9.0, -9.0, 1.0},
                         glm::dvec3{kNan, kFar, -kFar}};

TEST(Lens, SharesThePictureOutAmongItsViews) {
    for (const double aperture_m : {0.0, 0.003, 0.02, 1.0, 1e3}) {
        for (const std::uint32_t side : {1U, 2U, 9U, 25U}) {
            const LightField field{.cameras = {.columns = side, .rows = side},
                                   .lens = {.aperture_m = aperture_m}};
            for (const glm::dvec3& eye_m : kEyes_m) {
                double sum = 0.0;
                for (const WeightedView& view : views_of(field, eye_m)) {
                    EXPECT_GT(view.weight, 0.0);
                    EXPECT_LT(view.view, field.cameras.count());
                    sum += view.weight;
                }
                EXPECT_NEAR(sum, 1.0, 1e-12);
            }
        }
    }
}

TEST(Lens, TakesAsManyViewsAsItsOpeningCovers) {
    LightField field{.cameras = {.columns = 25, .rows = 25}, .lens = {.aperture_m = 0.0}};
    EXPECT_EQ(views_of(field, {}).size(), 1U) << "a camera stands where the eye is";
    EXPECT_EQ(views_of(field, {0.0025, 0.0025, 0.0}).size(), 4U);
    field.lens.aperture_m = 1.0;
    EXPECT_EQ(views_of(field, {}).size(), 625U);
    field.lens.aperture_m = 0.0099;
    const auto some = views_of(field, {});
    for (const WeightedView& view : some) {
        EXPECT_LT(glm::length(view.camera_m), 0.0149);
    }
    // Pi (r / spacing)^2 for r between the opening and a spacing more.
    EXPECT_GT(some.size(), 12U);
    EXPECT_LT(some.size(), 29U);
    field.lens.every_view = true;
    EXPECT_EQ(views_of(field, {}).size(), 625U);
}

// Without an opening it lies between its nearest cameras, of which there are at most four: one
// where it stands over a camera, two on the line between two. All places are in spacings from the
// middle one's camera; rounding makes no fifth view of any.
TEST(Lens, WithoutAnOpeningTakesTheNearestViewsAlone) {
    struct Place {
        glm::dvec2 at;
        std::size_t views;
    };
    for (const double spacing_m : {0.005, 0.0031, 0.1, 1.0 / 3.0}) {
        const LightField field{.cameras = {.columns = 25, .rows = 25, .spacing_m = spacing_m},
                               .lens = {.aperture_m = 0.0}};
        for (int column = -12; column <= 12; ++column) {
            for (int row = -12; row <= 12; ++row) {
                const glm::dvec2 camera = glm::dvec2(column, row);
                ASSERT_EQ(views_of(field, {spacing_m * camera, 0.0}).size(), 1U)
                    << column << ' ' << row << ' ' << spacing_m;
            }
        }
        for (const auto& [at, views] :
             {Place{{0.5, 0.0}, 2},
              {{3.0, -7.5}, 2},
              {{0.5, 0.5}, 4},
              {{-4.7, 8.4}, 4},
              // Over .71 from the nearest corner, a cell's farthest one is a spacing away.
              {{2.1, 2.1}, 3},
              // On the rim, at a corner of it, and outside: where the rectangle ends.
              {{12.0, 0.0}, 1},
              {{12.0, 3.5}, 2},
              {{12.0, 12.0}, 1},
              {{11.5, 11.5}, 4},
              {{900.0, 0.0}, 1},
              {{900.0, 3.5}, 2},
              {{-900.0, 900.0}, 1},
              {{0.5, -13.0}, 2}}) {
            EXPECT_EQ(views_of(field, {spacing_m * at, 0.0}).size(), views)
                << at.x << ' ' << at.y << ' ' << spacing_m;
        }
        EXPECT_EQ(most_views(field), 4U);
    }
    const LightField row{.cameras = {.columns = 9, .rows = 1}, .lens = {.aperture_m = 0.0}};
    EXPECT_EQ(most_views(row), 2U);
    const LightField one{.cameras = {.columns = 1, .rows = 1}, .lens = {.aperture_m = 0.0}};
    EXPECT_EQ(most_views(one), 1U);
    EXPECT_EQ(views_of(one, {9.0, 0.0, 0.0}).size(), 1U);
}

// Between cameras, weights are continuous: what a moved eye sees changes by as little as it moved.
TEST(Lens, LetsNoViewJumpIn) {
    const LightField field{.cameras = {.columns = 9, .rows = 9, .spacing_m = 0.005},
                           .lens = {.aperture_m = 0.007}};
    const auto weights = [&](double x_m) {
        std::vector<double> all(field.cameras.count());
        for (const WeightedView& view : views_of(field, {x_m, 0.001, 0.0})) {
            all.at(view.view) = view.weight;
        }
        return all;
    };
    constexpr double kStep_m = 1e-5;
    auto before = weights(-0.03);
    for (int step = 1; step < 6000; ++step) {
        const auto now = weights(-0.03 + step * kStep_m);
        for (std::size_t i = 0; i < now.size(); ++i) {
            // A weight rises by at most 1 per spacing, over a sum of at least 1.
            ASSERT_LE(std::abs(now[i] - before[i]), 2.0 * kStep_m / 0.005);
        }
        before = now;
    }
}

TEST(Lens, HasCamerasFromTopLeftToBottomRight) {
    const CameraGrid grid{.columns = 3, .rows = 2, .spacing_m = 0.1};
    EXPECT_EQ(grid.camera_m(0, 0), glm::dvec2(-0.1, 0.05));
    EXPECT_EQ(grid.camera_m(2, 1), glm::dvec2(0.1, -0.05));
}

TEST(Lens, RefusesGridsThatAreNone) {
    EXPECT_TRUE(check(CameraGrid{}).has_value());
    for (const CameraGrid& bad :
         {CameraGrid{.columns = 0}, CameraGrid{.rows = 65}, CameraGrid{.spacing_m = 0.0},
          CameraGrid{.spacing_m = kNan}, CameraGrid{.half_tangents = {kFar, 1.0}},
          CameraGrid{.half_tangents = {1.0, -1.0}}}) {
        EXPECT_FALSE(check(bad).has_value());
    }
}

// No lens takes more views than most_views() says, wherever it is, and not many fewer.
TEST(Lens, NeverTakesMoreViewsThanItsMost) {
    for (const double aperture_m : {0.0, 0.001, 0.005, 0.0099, 0.0151, 0.025, 0.05, 0.2}) {
        for (const auto& [columns, rows] : {std::pair{25U, 25U}, {9U, 3U}, {1U, 40U}}) {
            const LightField field{.cameras = {.columns = columns, .rows = rows},
                                   .lens = {.aperture_m = aperture_m}};
            const std::uint32_t most = most_views(field);
            std::size_t taken = 0;
            constexpr int kPlaces = 20;
            for (int i = 0; i <= kPlaces; ++i) {
                for (int j = 0; j <= kPlaces; ++j) {
                    // A spacing, around the middle.
                    const glm::dvec3 eye_m{0.005 * (static_cast<double>(i) / kPlaces),
                                           0.005 * (static_cast<double>(j) / kPlaces), 0.0};
                    taken = std::max(taken, views_of(field, eye_m).size());
                }
            }
            EXPECT_LE(taken, most) << aperture_m << ' ' << columns;
            if (aperture_m > 3 * 0.005) {
                EXPECT_GE(1.1 * static_cast<double>(taken), most) << aperture_m << ' ' << columns;
            }
        }
    }
    EXPECT_EQ(most_views({.cameras = {.columns = 25, .rows = 25}, .lens = {.aperture_m = 1e3}}),
              625U);
    EXPECT_EQ(most_views({.cameras = {.columns = 25, .rows = 25},
                          .lens = {.aperture_m = 0.0, .every_view = true}}),
              625U);
}

}  // namespace
}  // namespace gazeloop::light_field
