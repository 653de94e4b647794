#version 460
// An inset over the picture around it, each interpolated in linear light where its format is sRGB.
// The C++ side is Uniforms in runtime/openxr_layer/quad_views/inset_composite.cpp.
layout(std140, set = 0, binding = 0) uniform Composite {
    vec4 outer_part;   // of its texture: x, y, width, height
    vec4 outer_least;  // least and greatest texture coordinates that are its own
    vec4 inset_part;
    vec4 inset_least;
    vec4 covers;       // of the picture, px: x0, y0, width, height
    vec4 blend;        // per px from the inset's left, upper, right, lower edge
    vec4 size;         // of the picture, px: width, height
};
layout(set = 0, binding = 1) uniform sampler2D outer;
layout(set = 0, binding = 2) uniform sampler2D inset;
layout(location = 0) out vec4 color;

void main() {
    vec2 around = gl_FragCoord.xy / size.xy;
    vec2 within = (gl_FragCoord.xy - covers.xy) / covers.zw;
    vec4 under = texture(
        outer, clamp(outer_part.xy + around * outer_part.zw, outer_least.xy, outer_least.zw));
    vec4 over = texture(
        inset, clamp(inset_part.xy + within * inset_part.zw, inset_least.xy, inset_least.zw));
    vec2 low = (gl_FragCoord.xy - covers.xy) * blend.xy;
    vec2 high = (covers.xy + covers.zw - gl_FragCoord.xy) * blend.zw;
    vec2 nearest = min(low, high);
    float t = clamp(min(nearest.x, nearest.y), 0.0, 1.0);
    color = mix(under, over, t * t * (3.0 - 2.0 * t));
}
