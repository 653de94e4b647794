#pragma once

#include "runtime/foveation/eye/mar_line.h"
#include "runtime/foveation/picture/gaze_field.h"
#include "runtime/quality/plane.h"
#include "runtime/quality/row_work.h"

namespace gazeloop::quality {

/// How much each pixel counts: the cycles that the line resolves within it, its solid angle over
/// omega(e)^2. The sum over the picture is 1. Preconditions: check_mar_line accepts the line.
[[nodiscard]] Plane acuity_weights(const foveation::GazeField& field,
                                   const foveation::MarLine& line, const RowWork& work);

/// All pixels alike; the sum is 1.
[[nodiscard]] Plane equal_weights(std::uint32_t width, std::uint32_t height);

}  // namespace gazeloop::quality
