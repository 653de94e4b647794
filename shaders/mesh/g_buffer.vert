#version 460
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"
#include "instance.glsl"

layout(location = 0) in vec3 position_m;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec4 uv;
layout(location = 4) in vec4 color;

layout(location = 0) out vec3 world_normal;
layout(location = 1) out vec4 world_tangent;
layout(location = 2) out vec4 both_uv;
layout(location = 3) out vec4 vertex_color;

invariant gl_Position;

void main() {
    vec3 at_m = world_from_local(position_m, 1.0);
    gl_Position = view.clip_from_world * vec4(at_m, 1.0);
    // Normals go by the cofactors, which mirrored and unevenly scaled frames need.
    int row = 3 * gl_InstanceIndex;
    vec3 r0 = instance_rows[row].xyz;
    vec3 r1 = instance_rows[row + 1].xyz;
    vec3 r2 = instance_rows[row + 2].xyz;
    float side = dot(cross(r0, r1), r2) < 0.0 ? -1.0 : 1.0;
    world_normal = side * vec3(dot(cross(r1, r2), normal), dot(cross(r2, r0), normal),
                               dot(cross(r0, r1), normal));
    world_tangent = vec4(world_from_local(tangent.xyz, 0.0), tangent.w * side);
    both_uv = uv;
    vertex_color = color;
}
