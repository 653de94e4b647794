// What every pass knows of one eye's picture, whatever scene and method: descriptor set 0, the
// frame's. Set 1 is the scene's, set 2 the method's. The C++ side is runtime/render/frame_uniforms.h.
layout(std140, set = 0, binding = 0) uniform FrameUniforms {
    vec4 camera_and_time;  // eye position in world, m; scene time, s
    vec4 view_axes[3];     // columns of the view's rotation into world
    vec4 tangents;         // of the field of view: left, right, up, down
    vec4 image;            // width, height, px; how far samples are moved aside in this frame: x,
                           // y in cells, in (-.5, .5)
    vec4 last_camera;      // the last frame's eye position in world, m; 1, or 0 where there is none
    vec4 last_view_axes[3];
    vec4 last_tangents;
    vec4 offsets[16];      // samples in their cell: x, y in (-.5, .5); unused
} eye;

// Samples per texel or pixel. A constant of the pipeline: where control flow depends on a uniform,
// lavapipe 22.3 compiles the shader anew for every draw.
layout(constant_id = 1) const int kSamples = 1;

// Whether samples are moved aside, for what accumulates over frames.
layout(constant_id = 10) const bool kJittered = false;

const float kGreatestRadiance = 60000.0;  // what RGBA16F holds, with room for a filter's sum

vec2 image_size() { return eye.image.xy; }

vec3 view_to_world(vec3 v) {
    return eye.view_axes[0].xyz * v.x + eye.view_axes[1].xyz * v.y + eye.view_axes[2].xyz * v.z;
}

// The ray of a position in the picture, in world; not normalised in z-depth, unit length.
vec3 ray_direction(vec2 position_px) {
    vec2 at = position_px / image_size();
    vec3 local = vec3(mix(eye.tangents.x, eye.tangents.y, at.x),
                      mix(eye.tangents.z, eye.tangents.w, at.y), -1.0);
    return normalize(view_to_world(local));
}
