// Depth for a compositor that reprojects: kDepthNear_m / z, with z the distance along the view's
// axis; 1 at kDepthNear_m, 0 at infinity (runtime/render/depth.h says why). Shaders that write it are
// variants of their own (GAZELOOP_DEPTH): the mere statement costs a third of a resolve.
const float kDepthNear_m = 0.1;

void set_depth(vec2 position_px, float nearness) {
#ifdef GAZELOOP_DEPTH
    vec2 at = position_px / image_size();
    vec2 across = vec2(mix(eye.tangents.x, eye.tangents.y, at.x),
                       mix(eye.tangents.z, eye.tangents.w, at.y));
    gl_FragDepth = clamp(kDepthNear_m * nearness * sqrt(1.0 + dot(across, across)), 0.0, 1.0);
#endif
}
