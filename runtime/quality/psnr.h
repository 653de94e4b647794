#pragma once

#include "runtime/quality/plane.h"
#include "runtime/quality/row_work.h"
#include "runtime/render/host_picture.h"

namespace gazeloop::quality {

/// Peak signal to noise ratio of sRGB-encoded colours, dB: 10 log10(1 / mean squared error over
/// pixels and channels). Infinite where all that counts is equal. Symmetric. What a picture holds
/// beyond [0, 1] is cut, as a display does. `weights`: how much each pixel counts, with a sum of 1.
/// Preconditions: check_pictures accepts the two; the weights are of their size.
[[nodiscard]] double psnr_db(const render::LinearPicture& reference,
                             const render::LinearPicture& test, const Plane& weights,
                             const RowWork& work);

}  // namespace gazeloop::quality
