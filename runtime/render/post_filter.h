#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace gazeloop::render {

/// The size that a post filter has at most, if `most_px` is asked for: odd; 1 is no filter.
[[nodiscard]] constexpr std::uint32_t largest_post_filter(std::uint32_t most_px) {
    return most_px < 3 ? 1 : most_px - 1 + most_px % 2;
}

/// Size of the Gaussian over a resolved picture at a distance from the fovea (Meng et al. 2018, Eq.
/// 14): 3 + 2 * floor((r / rmax - .10) / .05) px, which is odd, from 3 at .10 to 39 at the farthest
/// corner. At most `largest`, an odd number; 1, which is no filter, nearer to the fovea. `share` is
/// r / rmax; beyond 1 it counts as 1, and what is no number as 0. Shares that are a hair below a
/// step count as on it, so that rounding does not decide. shaders/resolve/finish.frag has the same
/// in float.
[[nodiscard]] inline std::uint32_t post_filter_size(double share, std::uint32_t largest) {
    const double within = share > 0.0 ? std::min(share, 1.0) : 0.0;
    const double size = 3.0 + 2.0 * std::floor((within - 0.10) / 0.05 + 1e-4);
    return size < 3.0 ? 1 : std::min(static_cast<std::uint32_t>(size), largest);
}

}  // namespace gazeloop::render
