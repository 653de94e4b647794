#pragma once

namespace gazeloop::render {

/// What the values of a depth image stand for: kDepthNear_m / z, with z the distance along the
/// view's axis in metres. 1 is kDepthNear_m or nearer, 0 is infinitely far (the sky, and what no
/// eye sees). shaders/lib/depth.glsl computes it.
///
/// Where samples of several surfaces make up a pixel, its value is their mean, as its colour is.
/// The value kDepthNear_m / z is linear in how far a reprojection moves a point sideways. So the
/// mean moves the mixed colour by the mean distance. The LP-buffer holds 1 / distance with 11 bits:
/// the distance is known to 1 in 2048.
inline constexpr float kDepthNear_m = 0.1F;

}  // namespace gazeloop::render
