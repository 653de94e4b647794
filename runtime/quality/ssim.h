#pragma once

#include "runtime/error.h"
#include "runtime/quality/plane.h"
#include "runtime/quality/row_work.h"
#include "runtime/render/host_picture.h"

namespace gazeloop::quality {

/// The window of SSIM, px each way.
inline constexpr std::uint32_t kSsimWindow_px = 11;

/// Structural similarity of the sRGB-encoded luma (Rec.709 weights), 1: identical (Wang et al.
/// 2004: Gaussian window of 11x11 with sigma 1.5, K1 = .01, K2 = .03, range 1). Symmetric. Only
/// pixels with a whole window count, each by its weight. Preconditions: check_pictures accepts the
/// two; the weights are of their size, and not all of them lie in the 5 px that have no window.
/// Errors (BadInput): a side shorter than the window.
Expected<double> ssim(const render::LinearPicture& reference, const render::LinearPicture& test,
                      const Plane& weights, const RowWork& work);

}  // namespace gazeloop::quality
