#include "runtime/foveation/picture/hidden_area.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "runtime/foveation/picture/screen_wedge.h"
#include "tests/unit/foveation/picture/masks.h"

namespace gazeloop::foveation {
namespace {

using tests::cut_corners;
using tests::left_of;
using tests::outside_ellipse;
using tests::square_view;
using tests::visible_pixels;

bool inside(const gaze::HiddenTriangle& triangle, const glm::dvec2& point) {
    const auto side = [&](std::size_t i) {
        const glm::dvec2 a = triangle.corners[i] - point;
        const glm::dvec2 b = triangle.corners[(i + 1) % 3] - point;
        return a.x * b.y - a.y * b.x;
    };
    constexpr double kTolerance = 1e-12;
    const auto [least, greatest] = std::minmax({side(0), side(1), side(2)});
    return least >= -kTolerance || greatest <= kTolerance;
}

/// Whether a point of the picture lies in the mesh, by looking at every triangle.
bool inside(const gaze::HiddenMesh& mesh, ImageSize image, double x_px, double y_px) {
    const glm::dvec2 point{2.0 * x_px / image.width_px - 1.0, 1.0 - 2.0 * y_px / image.height_px};
    return std::ranges::any_of(
        mesh, [&](const gaze::HiddenTriangle& triangle) { return inside(triangle, point); });
}

/// Whether every point of a fine grid over what a pixel's neighbours read of it lies in the mesh.
bool surroundings_inside(const gaze::HiddenMesh& mesh, ImageSize image, std::uint32_t x,
                         std::uint32_t y) {
    constexpr int kSteps = 12;
    constexpr double kBorder = 1.0 / 64;
    for (int i = 0; i <= kSteps; ++i) {
        for (int j = 0; j <= kSteps; ++j) {
            const double at_x =
                std::clamp(x - 0.5 + 2.0 * i / kSteps, kBorder, image.width_px - kBorder);
            const double at_y =
                std::clamp(y - 0.5 + 2.0 * j / kSteps, kBorder, image.height_px - kBorder);
            if (!inside(mesh, image, at_x, at_y)) {
                return false;
            }
        }
    }
    return true;
}

struct Count {
    std::uint64_t hidden = 0;    ///< by the area
    std::uint64_t hideable = 0;  ///< by looking
};

/// Nothing may be hidden that could be seen; the tiles and the count must agree.
Count check(const gaze::HiddenMesh& mesh, ImageSize image) {
    const HiddenArea area(mesh, square_view(image.width_px, image.height_px));
    const std::vector<bool> visible = visible_pixels(area, image);
    Count count;
    for (std::uint32_t y = 0; y < image.height_px; ++y) {
        for (std::uint32_t x = 0; x < image.width_px; ++x) {
            const bool hideable = surroundings_inside(mesh, image, x, y);
            count.hideable += hideable ? 1 : 0;
            if (!visible[std::size_t{y} * image.width_px + x]) {
                ++count.hidden;
                EXPECT_TRUE(hideable) << x << ' ' << y;
            }
        }
    }
    EXPECT_EQ(area.hidden_pixels(), count.hidden);
    std::uint64_t tiled = 0;
    for (const Tile& tile : area.visible_tiles()) {
        tiled += tile.area();
    }
    EXPECT_EQ(tiled + count.hidden, std::uint64_t{image.width_px} * image.height_px);
    return count;
}

TEST(HiddenArea, HidesWhatNobodySeesAndLittleLess) {
    for (const ImageSize image : {ImageSize{120, 96}, ImageSize{97, 131}}) {
        for (const gaze::HiddenMesh& mesh :
             {outside_ellipse(0.9, 48), outside_ellipse(0.5, 24), cut_corners(0.3)}) {
            const Count count = check(mesh, image);
            // Groups of rows are coarse for pictures this small.
            EXPECT_GT(static_cast<double>(count.hidden), 0.6 * static_cast<double>(count.hideable));
        }
    }
}

// Along an edge of whole pixels nothing is lost to the groups: exact.
TEST(HiddenArea, EndsAPixelInsideAnEdge) {
    constexpr ImageSize kImage{64, 48};
    for (const double x_px : {16.0, 17.25, 17.5, 17.75, 18.0}) {
        const double cut = x_px / 32.0 - 1.0;
        const HiddenArea area(left_of(cut), square_view(64, 48));
        // Pixel x is read up to x + 1.5.
        const auto pixel = static_cast<std::uint32_t>(std::floor(x_px - 1.5)) + 1;
        const std::uint32_t first = pixel / 4 * 4;
        for (std::uint32_t y = 0; y < kImage.height_px; y += kBandRows) {
            EXPECT_EQ(area.visible_columns(y).first, first) << x_px;
            EXPECT_EQ(area.visible_columns(y).end, 64U);
        }
        EXPECT_EQ(area.hidden_pixels(), std::uint64_t{48} * first);
        EXPECT_EQ(area.visible_tiles().size(), 1U);
    }
}

TEST(HiddenArea, HidesNothingThatCouldBeSeenOfAnyMesh) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> at(-4.0, 4.0);
    std::uniform_int_distribution<int> triangles(1, 6);
    std::uint64_t hidden = 0;
    for (int round = 0; round < 60; ++round) {
        gaze::HiddenMesh mesh;
        for (int i = triangles(random); i > 0; --i) {
            const glm::dvec2 last = mesh.empty() ? glm::dvec2{0.3, -0.8} : mesh.back().corners[2];
            mesh.push_back(
                {{last, glm::dvec2{at(random), at(random)}, glm::dvec2{at(random), at(random)}}});
        }
        hidden += check(mesh, {40, 36}).hidden;
    }
    EXPECT_GT(hidden, 1000U);
}

// The seam between two triangles is inside the mesh, and triangles that only overlap are not
// trusted with it.
TEST(HiddenArea, SeesNoSeamBetweenTrianglesThatShareAnEdge) {
    constexpr ImageSize kImage{64, 64};
    EXPECT_EQ(check(left_of(-0.5), kImage).hidden, 64U * 12U);
    gaze::HiddenMesh reversed = left_of(-0.5);
    std::swap(reversed[1].corners[0], reversed[1].corners[2]);
    EXPECT_EQ(check(reversed, kImage).hidden, 64U * 12U);
    gaze::HiddenMesh overlapping = left_of(-0.5);
    overlapping[1].corners[0].x = -1.9;
    EXPECT_LE(check(overlapping, kImage).hidden, 64U * 12U);
}

// A mask ends at the picture's edges: what reaches into it from the side, with the picture above
// and below, is displaced.
TEST(HiddenArea, IsNoIslandAndNoBay) {
    for (const double left : {-2.0, 0.2}) {
        const gaze::HiddenMesh mesh{{{glm::dvec2{left, -0.5}, {0.8, -0.5}, {0.8, 0.5}}},
                                    {{glm::dvec2{left, -0.5}, {0.8, 0.5}, {left, 0.5}}}};
        EXPECT_EQ(check(mesh, {128, 128}).hidden, 0U) << left;
    }
}

TEST(HiddenArea, LeavesOutWhatCannotBeDrawn) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (const double bad : {kNan, kInfinity, -kInfinity, 1e300, 1e12}) {
        const HiddenArea alone({{{glm::dvec2{-bad, -3}, glm::dvec2{bad, -3}, glm::dvec2{0, bad}}}},
                               square_view(64, 48));
        EXPECT_EQ(alone.hidden_pixels(), 0U) << bad;
        gaze::HiddenMesh mesh = left_of(0.0);
        mesh.push_back({{glm::dvec2{bad, 0}, glm::dvec2{0, bad}, glm::dvec2{1, 1}}});
        EXPECT_EQ(HiddenArea(mesh, square_view(64, 48)).hidden_pixels(), 28U * 48U) << bad;
    }
    const glm::dvec2 point{0.1, 0.2};
    EXPECT_EQ(HiddenArea({{{point, point, point}}}, square_view(64, 48)).hidden_pixels(), 0U);
    EXPECT_EQ(HiddenArea({}, square_view(64, 48)).hidden_pixels(), 0U);
}

TEST(HiddenArea, TakesEveryPictureSize) {
    for (const std::uint32_t side : {1U, 2U, 3U, 16U, 17U, 16384U}) {
        const HiddenArea whole(left_of(2.0), square_view(side, side));
        EXPECT_EQ(whole.hidden_pixels(), std::uint64_t{side} * side);
        EXPECT_TRUE(whole.visible_tiles().empty());
        EXPECT_FALSE(radii_in_wedge(whole.outline(), {1, 1}, 0.0, 1.0).has_value());
        const HiddenArea none(left_of(-1.0), square_view(side, side));
        EXPECT_EQ(none.hidden_pixels(), 0U);
        const auto radii = radii_in_wedge(none.outline(), {0, 0}, 0.0, 7.0);
        ASSERT_TRUE(radii.has_value());
        EXPECT_NEAR(radii->max_px, (side - 0.5) * std::sqrt(2.0), 1e-9);
        EXPECT_NEAR(radii->min_px, 0.5 * std::sqrt(2.0), 1e-9);
    }
    const HiddenArea large(outside_ellipse(1.0, 256), square_view(16384, 16384));
    EXPECT_NEAR(static_cast<double>(large.hidden_pixels()) / (16384.0 * 16384.0),
                1.0 - std::numbers::pi / 4.0, 0.002);
}

TEST(HiddenArea, BoundsTheVisiblePixelsDistances) {
    constexpr ImageSize kImage{90, 70};
    const gaze::HiddenMesh mesh = outside_ellipse(0.8, 40);
    const HiddenArea area(mesh, square_view(90, 70));
    const std::vector<bool> visible = visible_pixels(area, kImage);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> x(-40.0, 130.0);
    std::uniform_real_distribution<double> y(-40.0, 110.0);
    std::uniform_real_distribution<double> angle(-3.0, 3.0);
    std::uniform_real_distribution<double> width(0.02, 2.0);
    for (int round = 0; round < 300; ++round) {
        const gaze::PixelPosition fovea{x(random), y(random)};
        const double from = angle(random);
        const double to = from + width(random);
        const auto range = radii_in_wedge(area.outline(), fovea, from, to);
        for (std::uint32_t row = 0; row < kImage.height_px; ++row) {
            for (std::uint32_t column = 0; column < kImage.width_px; ++column) {
                const double dx = column + 0.5 - fovea.x_px;
                const double dy = row + 0.5 - fovea.y_px;
                double at = std::atan2(dy, dx);
                at += at < from ? 2.0 * std::numbers::pi : 0.0;
                if (!visible[std::size_t{row} * kImage.width_px + column] || at > to) {
                    continue;
                }
                ASSERT_TRUE(range.has_value());
                ASSERT_LE(range->min_px, std::hypot(dx, dy) + 1e-9);
                ASSERT_GE(range->max_px, std::hypot(dx, dy) - 1e-9);
            }
        }
    }
}

TEST(HiddenAreas, AreNoneWhereNothingOrEverythingIsHidden) {
    const gaze::StereoView views{square_view(64, 48), square_view(64, 48)};
    EXPECT_EQ(hidden_areas(nullptr, views)[0], nullptr);
    const auto meshes = std::make_shared<const gaze::PerEye<gaze::HiddenMesh>>(
        gaze::PerEye<gaze::HiddenMesh>{left_of(0.0), left_of(2.0)});
    const HiddenAreas areas = hidden_areas(meshes, views);
    ASSERT_NE(areas[0], nullptr);
    EXPECT_EQ(areas[0]->hidden_pixels(), 28U * 48U);
    EXPECT_EQ(areas[1], nullptr);
}

}  // namespace
}  // namespace gazeloop::foveation
