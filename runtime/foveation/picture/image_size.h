#pragma once

#include <cstdint>

namespace gazeloop::foveation {

/// Size of a picture, px.
struct ImageSize {
    std::uint32_t width_px = 0;
    std::uint32_t height_px = 0;
};

}  // namespace gazeloop::foveation
