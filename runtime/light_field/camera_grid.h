#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "runtime/error.h"

namespace gazeloop::light_field {

/// The cameras of a light field: evenly spaced in the plane z = 0 of world, around its origin, each
/// looking along -Z with the same field of view. View `row * columns + column` is the camera's
/// picture; row 0 is the top one, column 0 the leftmost.
struct CameraGrid {
    static constexpr std::uint32_t kMostPerSide = 64;

    std::uint32_t columns = 1;  ///< [1, kMostPerSide]
    std::uint32_t rows = 1;     ///< [1, kMostPerSide]
    double spacing_m = 0.005;   ///< between neighbours, both ways; [1e-6, 10]
    /// Tangents of half the field of view, across and down; [.001, 100].
    glm::dvec2 half_tangents{1.0};

    [[nodiscard]] std::uint32_t count() const { return columns * rows; }
    /// Where the camera of a place stands in its plane: x to the right, y up.
    [[nodiscard]] glm::dvec2 camera_m(std::uint32_t column, std::uint32_t row) const {
        return {(column - 0.5 * (columns - 1)) * spacing_m, (0.5 * (rows - 1) - row) * spacing_m};
    }
    /// Half the sides of the rectangle that the cameras span.
    [[nodiscard]] glm::dvec2 half_extent_m() const {
        return {0.5 * (columns - 1) * spacing_m, 0.5 * (rows - 1) * spacing_m};
    }
};

/// Errors (BadInput): the first value out of its range, with the range.
[[nodiscard]] Expected<void> check(const CameraGrid& grid);

}  // namespace gazeloop::light_field
