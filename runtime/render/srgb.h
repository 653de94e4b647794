#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

namespace gazeloop::render {

/// IEC 61966-2-1, both in [0, 1]; what lies beyond is cut.
[[nodiscard]] double srgb_encoded(double linear);
[[nodiscard]] double srgb_decoded(double encoded);

/// An 8-bit sRGB colour in linear light.
[[nodiscard]] glm::vec3 linear_of(const std::array<std::uint8_t, 3>& codes);

}  // namespace gazeloop::render
