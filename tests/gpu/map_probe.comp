#version 460
#extension GL_GOOGLE_include_directive : require
// Runs the map's functions on the device, so that tests can compare them with double precision.
layout(local_size_x = 64) in;

#include "lib/frame.glsl"
#include "lib/log_polar.glsl"

layout(std430, set = 0, binding = 6) readonly buffer Inputs { vec4 inputs[]; };
layout(std430, set = 0, binding = 7) writeonly buffer Outputs { vec4 outputs[]; };

// inputs: picture position (xy), column and row (zw).
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= inputs.length()) {
        return;
    }
    vec2 lp = lp_position(inputs[i].xy);
    ivec2 cell = ivec2(inputs[i].zw);
    vec2 position =
        picture_position(column_radii(cell.x), row_table[cell.y], vec4(0.0, 0.0, 1.0, 0.0));
    outputs[2 * i] = vec4(lp, position);
    outputs[2 * i + 1] = vec4(ray_direction(inputs[i].xy), 0.0);
}
