#version 460
#extension GL_GOOGLE_include_directive : require
// Runs the maps' functions on the device, so that they can be compared with double precision.
layout(local_size_x = 64) in;

#include "../lib/frame.glsl"
#include "../lib/log_polar.glsl"
#include "../lib/gaze_frame.glsl"

layout(std430, set = 2, binding = 4) readonly buffer Inputs { vec4 inputs[]; };
layout(std430, set = 2, binding = 5) writeonly buffer Outputs { vec4 outputs[]; };

// inputs: picture position (xy), column and row (zw). outputs: two vectors, share (xy) and ray of
// the position, then the texel's position in the picture or ray in the view (xyz).
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= inputs.length()) {
        return;
    }
    ivec2 cell = ivec2(inputs[i].zw);
    vec2 share = kInGazeFrame ? gaze_lp_share(inputs[i].xy) : lp_share(inputs[i].xy);
    vec2 direction = row_table[cell.y];
    vec3 place;
    if (kInGazeFrame) {
        vec3 ray = gaze_ray_at(column_values(cell.x).y, direction);
        place = map.view_from_gaze[0].xyz * ray.x + map.view_from_gaze[1].xyz * ray.y +
                map.view_from_gaze[2].xyz * ray.z;
    } else {
        place = vec3(picture_position(column_radii(cell.x).y, direction), 0.0);
    }
    vec3 ray = ray_direction(inputs[i].xy);
    outputs[2 * i] = vec4(share, ray.xy);
    outputs[2 * i + 1] = vec4(place, ray.z);
}
