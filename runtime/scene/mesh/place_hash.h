#pragma once

#include <cstdint>

namespace gazeloop::scene::mesh {

/// A number in [0, 1) that only the place and the seed decide: what looks random in generated
/// scenes and is the same everywhere.
inline double hashed(std::int32_t x, std::int32_t y, std::uint32_t seed) {
    std::uint32_t h = static_cast<std::uint32_t>(x) * 0x9E3779B1U ^
                      static_cast<std::uint32_t>(y) * 0x85EBCA77U ^ seed * 0xC2B2AE3DU;
    h = (h ^ (h >> 15U)) * 0x2C1B3C6DU;
    h = (h ^ (h >> 12U)) * 0x297A2D39U;
    return static_cast<double>((h ^ (h >> 15U)) >> 8U) / 16777216.0;
}

}  // namespace gazeloop::scene::mesh
