#pragma once

#include <cstdint>

namespace gazeloop::numerics {

struct DrawCounts {
    std::uint64_t draws = 0;
    std::uint64_t not_finite = 0;
    std::uint64_t outside = 0;  ///< shares outside [0, 1]
};

/// Draws random maps of every kind with parameters from end to end of their ranges. Pictures have
/// sides of 2 to 16384 px. Gazes lie up to twice the size outside (or in any direction), and
/// positions on, around and far from the picture. Asks the float mirror both ways.
DrawCounts draw_extremes(std::uint64_t draws, std::uint64_t seed);

}  // namespace gazeloop::numerics
