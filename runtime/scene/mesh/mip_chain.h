#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/scene/mesh/mesh_data.h"

namespace gazeloop::scene::mesh {

struct MipLevel {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::byte> texels;  ///< as the image's
};

/// The smaller levels of an image, from half its size (rounded down) to 1 x 1. Each texel is the
/// mean of exactly the part of the level above that it covers, also where that has an odd size;
/// colours are averaged as light, not as codes.
[[nodiscard]] std::vector<MipLevel> smaller_levels(const Image& image);

/// The same picture with colours as light, for which Vulkan has no sRGB format: those of 16 bits.
/// A step of light is 1/65535 of white, at the dark end a twentieth of a code of 8 bits.
[[nodiscard]] Image as_light(const Image& image);

}  // namespace gazeloop::scene::mesh
