#pragma once

#include <cstdint>

#include "runtime/scene/mesh/mesh_data.h"

namespace gazeloop::scene::gallery {

/// The patterns of the gallery's materials, each seamless.
enum class Pattern : std::uint8_t { Plaster, Stone, Brick, Wood, Tile, Hammered, Brushed, Ground };

/// What a material reads of a pattern.
struct PatternImages {
    mesh::Image color;    ///< sRGB
    mesh::Image normal;   ///< linear
    mesh::Image surface;  ///< linear: r occlusion, g roughness, b 255 (metallic is the factor's)
};

/// `size` texels each way, a power of two.
[[nodiscard]] PatternImages paint(Pattern pattern, std::uint32_t size);

}  // namespace gazeloop::scene::gallery
