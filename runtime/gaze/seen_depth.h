#pragma once

#include <cstdint>
#include <vector>

#include "runtime/gaze/view.h"

namespace gazeloop::gaze {

/// The depth that one eye's picture shows around its fovea: one sample every `step` pixels, row by
/// row. It has no samples where nothing is known.
struct DepthPatch {
    EyeView view;             ///< that the picture was rendered from
    std::uint32_t x0_px = 0;  ///< the pixel of the first sample
    std::uint32_t y0_px = 0;
    std::uint32_t step_x_px = 1;
    std::uint32_t step_y_px = 1;
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    /// 1 / distance from the eye, 1/m, as half floats; 0 is infinitely far, and a value that is
    /// negative or no number is unknown. columns * rows of them.
    std::vector<std::uint16_t> nearness;
};

using SeenDepth = PerEye<DepthPatch>;

}  // namespace gazeloop::gaze
