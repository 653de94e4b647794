#pragma once

#include <cstdint>
#include <span>

#include "runtime/foveation/picture/band_tiles.h"
#include "runtime/foveation/picture/image_size.h"
#include "runtime/gaze/view.h"

namespace gazeloop::foveation {

/// A rectangle around a place, of pixels that a plan shades directly (`disc_bands`: the bands of
/// LogPolarPlan's disc). It reaches at most `reach_x_px` to both sides of the place, and
/// `reach_y_px` above and below. Towards the disc's narrow ends, rows that would leave less than
/// half of the columns are left out. Empty where the place is off screen, not a number or in a
/// pixel that is not shaded.
[[nodiscard]] Tile shaded_around(const gaze::PixelPosition& place, std::uint32_t reach_x_px,
                                 std::uint32_t reach_y_px, ImageSize image,
                                 std::span<const Columns> disc_bands);

}  // namespace gazeloop::foveation
