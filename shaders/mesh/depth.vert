#version 460
#extension GL_GOOGLE_include_directive : require
// Depth alone: shadow maps, and before the G-buffer where that is asked for.
#include "view.glsl"
#include "instance.glsl"

layout(location = 0) in vec3 position_m;
layout(location = 3) in vec4 uv;
layout(location = 4) in vec4 color;
layout(location = 0) out vec4 both_uv;
layout(location = 1) out float vertex_alpha;

invariant gl_Position;

void main() {
    gl_Position = view.clip_from_world * vec4(world_from_local(position_m, 1.0), 1.0);
    both_uv = uv;
    vertex_alpha = color.a;
}
