#pragma once

#include "runtime/error.h"
#include "runtime/quality/plane.h"
#include "runtime/quality/row_work.h"
#include "runtime/render/host_picture.h"

namespace gazeloop::quality {

/// The window of SSIM, px each way.
inline constexpr std::uint32_t kSsimWindow_px = 11;

/// Structural similarity of the sRGB-encoded luma (Rec.709 weights) at each pixel with a whole
/// window, 1: identical (Wang et al. 2004: Gaussian window of 11x11 with sigma 1.5, K1 = .01,
/// K2 = .03, range 1). Symmetric. The map has 10 px less each way: its first pixel is the
/// pictures' 5,5. Precondition: check_pictures accepts the two. Errors (BadInput): a side shorter
/// than the window.
Expected<Plane> ssim_map(const render::LinearPicture& reference, const render::LinearPicture& test,
                         const RowWork& work);

/// The map's mean, each pixel by its weight. Preconditions: `weights` are of the pictures' size,
/// and not all of them lie in the 5 px that have no window.
[[nodiscard]] double mean_ssim(const Plane& map, const Plane& weights);

}  // namespace gazeloop::quality
