// What follows a method's picture (runtime/render/passes/antialiased_passes.cpp has the C++ side).
layout(std140, set = 2, binding = 0) uniform FinishUniforms {
    vec4 fovea;     // px; 1 / distance of the farthest corner, 1/px; radius of the disc, px
    vec4 sampling;  // angle between samples around the fovea, rad, or 0: pixels; unused
} finish;

// What is shown where no eye sees it: alpha 0.
layout(set = 2, binding = 2) uniform sampler2D shown;
layout(set = 2, binding = 3) uniform sampler2D shown_depth;

// How far apart the samples around a position lie, px; at least 1.
float spacing_px(vec2 position_px) {
    float r = distance(position_px, finish.fovea.xy);
    return r <= finish.fovea.w ? 1.0 : max(1.0, finish.sampling.x * r);
}
