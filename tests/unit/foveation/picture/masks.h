#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "runtime/foveation/picture/hidden_area.h"

namespace gazeloop::tests {

/// A view whose tangents run from -1 to 1 on both axes.
inline gaze::EyeView square_view(std::uint32_t width_px, std::uint32_t height_px) {
    constexpr double kEdge = std::numbers::pi / 4.0;
    return {.fov = {-kEdge, kEdge, kEdge, -kEdge}, .width_px = width_px, .height_px = height_px};
}

/// The corners of that view, `leg` of its width and height long.
inline gaze::HiddenMesh cut_corners(double leg) {
    const double cut = 1.0 - 2.0 * leg;
    gaze::HiddenMesh mesh;
    for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0}) {
            mesh.push_back({{glm::dvec2{x, y}, glm::dvec2{x, y * cut}, glm::dvec2{x * cut, y}}});
        }
    }
    return mesh;
}

/// What lies outside of a polygon inscribed in an ellipse, out to well beyond the view: a ring of
/// triangles that share their edges.
inline gaze::HiddenMesh outside_ellipse(double radius, int corners) {
    gaze::HiddenMesh mesh;
    const auto at = [&](int i, double r) {
        const double angle = 2.0 * std::numbers::pi * (i % corners) / corners;
        return glm::dvec2{r * std::cos(angle), r * std::sin(angle)};
    };
    constexpr double kBeyond = 3.0;
    for (int i = 0; i < corners; ++i) {
        mesh.push_back({{at(i, radius), at(i + 1, radius), at(i, kBeyond)}});
        mesh.push_back({{at(i + 1, kBeyond), at(i, kBeyond), at(i + 1, radius)}});
    }
    return mesh;
}

/// What lies to the left of a tangent.
inline gaze::HiddenMesh left_of(double x) {
    return {{{glm::dvec2{-2, -2}, glm::dvec2{x, -2}, glm::dvec2{x, 2}}},
            {{glm::dvec2{-2, -2}, glm::dvec2{x, 2}, glm::dvec2{-2, 2}}}};
}

/// Pixel by pixel, row by row, whether it is in one of the visible tiles.
inline std::vector<bool> visible_pixels(const foveation::HiddenArea& area,
                                        foveation::ImageSize image) {
    std::vector<bool> visible(std::size_t{image.width_px} * image.height_px, false);
    for (const foveation::Tile& tile : area.visible_tiles()) {
        for (std::uint32_t y = tile.y0; y < tile.y1; ++y) {
            for (std::uint32_t x = tile.x0; x < tile.x1; ++x) {
                visible[std::size_t{y} * image.width_px + x] = true;
            }
        }
    }
    return visible;
}

}  // namespace gazeloop::tests
