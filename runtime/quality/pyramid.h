#pragma once

#include <cstdint>

#include "runtime/quality/plane.h"
#include "runtime/quality/row_work.h"

namespace gazeloop::quality {

// The Laplacian pyramid (Burt and Adelson 1983, with their a = .4): each level is the one before,
// low-passed by (1 5 8 5 1)/20 each way and halved; a band is a level less the next one, expanded.
// Beyond its edges, a plane goes on as at them.

/// The side of the next level.
[[nodiscard]] constexpr std::uint32_t halved(std::uint32_t side) { return (side + 1) / 2; }

/// Writes the next level, which is made of its size if it is not.
void reduce(const Plane& level, const RowWork& work, Plane& next);

/// One row of the next level, expanded to `width` (halved(width) == next.width) into `row`.
/// `scratch` has room for next.width values. Precondition: y / 2 < next.height.
void expand_row(const Plane& next, std::uint32_t y, std::uint32_t width, float* scratch,
                float* row);

/// The frequency that a band stands for, cycles per pixel of the level it is made from: where its
/// response is largest, by the filter's W(f) = .4 + .5 cos(2 pi f) + .1 cos(4 pi f). The finest
/// band passes all that is above it; the others are an octave and a half wide. `gain`: what such a
/// grating keeps. In the coarser bands that is .543 of the band itself, and with what the bands
/// beside it see, .62.
struct BandResponse {
    double cycles_per_px;
    double gain;
};
inline constexpr BandResponse kFinestBand{0.3, 0.973};
inline constexpr BandResponse kCoarserBand{0.2115, 0.62};

}  // namespace gazeloop::quality
