#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace gazeloop::render {

/// A picture on the host: 8 bits per channel, sRGB-encoded RGB, top row first.
struct Picture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::array<std::uint8_t, 3>> pixels;
};

/// A picture on the host in linear light, Rec.709 primaries, top row first. In units of the scene's
/// radiance; what an 8-bit target held is decoded and lies in [0, 1].
struct LinearPicture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<glm::vec3> pixels;
};

}  // namespace gazeloop::render
