// What every pass knows of one eye's picture. The C++ side is runtime/render/eye_uniforms.h.
layout(std140, set = 0, binding = 0) uniform EyeUniforms {
    vec4 camera_and_time;     // eye position in world, m; scene time, s
    vec4 view_axes[3];        // columns of the view's rotation into world
    vec4 tangents;            // of the field of view: left, right, up, down
    vec4 image_and_bands;     // width, height, px; bands of the LP-buffer; unused
    vec4 fovea_and_log2;      // fovea, px; log2 of the farthest radius; .5 / that
    vec4 lp_and_disc;         // LP-buffer's width, height; disc radius and its border, px or sin(e/2)
    vec4 radius;              // picture frame: farthest radius, px; 1 / its square; unused
    vec4 gaze_from_picture[3];  // gaze frame: columns; (x_px, y_px, 1) to the gaze's ray
    vec4 view_from_gaze[3];   // gaze frame: columns of its rotation into the view
    vec4 offsets[16];         // samples in their cell: x, y in (-.5, .5); cosine, sine of y rows
} eye;

// Samples a texel or pixel. A constant of the pipeline: where control flow depends on a uniform,
// lavapipe 22.3 compiles the shader anew for every draw.
layout(constant_id = 1) const int kSamples = 1;

// Whether the log-polar map is centred by a rotation into the gaze's frame or, in the picture, by a
// translation.
layout(constant_id = 2) const bool kInGazeFrame = false;

const float kGreatestRadiance = 60000.0;  // what RGBA16F holds, with room for a filter's sum

vec2 image_size() { return eye.image_and_bands.xy; }

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
