#version 460
#extension GL_GOOGLE_include_directive : require
// A list of rectangles as instances of two triangles: only what the sampling plan asks for is
// rasterised. Tiles are half open: x0, y0, x1, y1; first those of the LP-buffer, then those of
// pixels that are shaded directly.
#include "frame.glsl"

layout(std430, set = 0, binding = 4) readonly buffer Tiles { uvec4 tiles[]; };
layout(location = 0) flat out int direct;

void main() {
    uvec4 tile = tiles[gl_InstanceIndex];
    vec2 corner = vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1);
    vec2 position = mix(vec2(tile.xy), vec2(tile.zw), corner);
    direct = gl_InstanceIndex >= int(eye.image_and_tiles.z) ? 1 : 0;
    vec2 target_size = direct != 0 ? image_size() : eye.lp_and_disc.xy;
    gl_Position = vec4(position / target_size * 2.0 - 1.0, 0.0, 1.0);
}
