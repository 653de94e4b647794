#pragma once

#include "runtime/foveation/picture/band_tiles.h"
#include "runtime/foveation/picture/gaze_frame.h"

namespace gazeloop::foveation {

/// The columns of the pixels of rows [y0, y1) whose centres lie within an eccentricity of the gaze,
/// and of all between them. Float rounding in a shader moves no pixel out. From 90 degrees on, all
/// columns.
[[nodiscard]] Columns columns_within(const GazeFrame& frame, double eccentricity_rad,
                                     std::uint32_t y0, std::uint32_t y1);

}  // namespace gazeloop::foveation
