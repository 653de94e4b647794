#pragma once

#include <cstdint>

namespace gazeloop::foveation {

/// A rectangle of texels or pixels, half open.
struct Tile {
    std::uint32_t x0 = 0;
    std::uint32_t y0 = 0;
    std::uint32_t x1 = 0;
    std::uint32_t y1 = 0;

    [[nodiscard]] std::uint64_t area() const {
        return std::uint64_t{x1 - x0} * std::uint64_t{y1 - y0};
    }
};

}  // namespace gazeloop::foveation
