// Depth for a compositor that reprojects: kDepthNear_m / z, with z the distance along the view's
// axis; 1 at kDepthNear_m, 0 at infinity (runtime/render/depth.h says why). Shaders that write it are
// variants of their own (GAZELOOP_DEPTH): the mere statement costs a third of a resolve.
const float kDepthNear_m = 0.1;

// Along the view's axis over along the ray of a position.
float axis_over_ray(vec2 position_px) {
    vec2 at = position_px / image_size();
    vec2 across = vec2(mix(eye.tangents.x, eye.tangents.y, at.x),
                       mix(eye.tangents.z, eye.tangents.w, at.y));
    return sqrt(1.0 + dot(across, across));
}

// 1 / distance, 1/m, of what such a depth says.
float nearness_of(vec2 position_px, float depth) {
    return depth / (kDepthNear_m * axis_over_ray(position_px));
}

void set_depth(vec2 position_px, float nearness) {
#ifdef GAZELOOP_DEPTH
    gl_FragDepth = clamp(kDepthNear_m * nearness * axis_over_ray(position_px), 0.0, 1.0);
#endif
}
