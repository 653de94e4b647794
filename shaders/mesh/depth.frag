#version 460
#extension GL_GOOGLE_include_directive : require
// Holes of masked materials; others need no fragment shader.
#include "material.glsl"

layout(location = 0) in vec4 both_uv;
layout(location = 1) in float vertex_alpha;

void main() {
    float alpha = material.base_color.a * vertex_alpha;
    if (has_texture(kBaseColor)) {
        alpha *= texture(base_color_texture, texture_place(kBaseColor, both_uv)).a;
    }
    if (alpha < material.emissive.w) {
        discard;
    }
}
