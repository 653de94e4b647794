#pragma once

#include <cstdint>
#include <string>

#include "runtime/quality/comparison.h"
#include "runtime/render/host_picture.h"

namespace gazeloop::trade {

/// The longest side of what is kept of a point's pictures.
inline constexpr std::uint32_t kMostPictureSide_px = 480;

/// A picture made small: each pixel is the mean, in linear light, of the square of pixels that it
/// stands for. As PNG in base64. Precondition: it has pixels.
[[nodiscard]] std::string small_picture(const render::LinearPicture& picture);

/// The map of contrast, or else of FLIP, made small in the same way, as colours. Empty: the
/// comparison has no map.
[[nodiscard]] std::string small_heat_map(const quality::FrameQuality& quality);

}  // namespace gazeloop::trade
