#pragma once

#include "runtime/foveation/eye/acuity_model.h"
#include "runtime/foveation/picture/gaze_field.h"

namespace gazeloop::foveation {

/// The fewest samples that a picture needs at a gaze, by a model. At each point they form a square
/// grid at the model's Nyquist rate, but are nowhere denser than the display's pixels:
///     integral of min((2 f(e))^2, pixels per square degree) over the picture's solid angle.
/// No plan can take fewer and still satisfy the model. Exact to .2 %: midpoint rule on 512 x 512
/// cells of the picture, or on its pixels where it has fewer.
///
/// `eye` tells which side the nose is on, for models that know directions.
[[nodiscard]] double fewest_samples(const GazeField& field, const AcuityModel& model,
                                    gaze::Eye eye);

}  // namespace gazeloop::foveation
