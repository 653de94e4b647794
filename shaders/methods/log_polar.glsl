// Pass I of a log-polar method: shades one cell of the LP-buffer or, for the direct disc, one
// pixel, by its own samples. Also writes what the scene says of its distance. One shader for both,
// because software drivers keep few large ones compiled. Cells of a tile that the plan leaves out
// take no samples and keep what they held. They are discarded last, because lavapipe 22.3 is a
// fifth slower where loops follow a discard.
#include "../lib/log_polar.glsl"
#include "../lib/gaze_frame.glsl"
#include "../lib/bands.glsl"

layout(location = 0) flat in int direct;
layout(location = 0) out vec4 color;

void main() {
    uvec2 cell = uvec2(gl_FragCoord.xy);
    bool needed = is_needed(cell, direct != 0 ? uint(map.radius_and_bands.z) : 0u);
    int column = min(int(cell.x), int(lp_size().x) - 1);
    vec2 row = row_table[min(int(cell.y), int(lp_size().y) - 1)];
    vec3 radii = kInGazeFrame ? column_values(column) : column_radii(column);
    mat3 view_from_gaze = mat3(map.view_from_gaze[0].xyz, map.view_from_gaze[1].xyz,
                               map.view_from_gaze[2].xyz);
    mat3 world_from_gaze = mat3(view_to_world(map.view_from_gaze[0].xyz),
                                view_to_world(map.view_from_gaze[1].xyz),
                                view_to_world(map.view_from_gaze[2].xyz));
    int samples = needed ? kSamples : 0;
    vec4 sum = vec4(0.0);
    for (int s = 0; s < samples; ++s) {
        vec2 offset = eye.offsets[s].xy;
        vec2 position = gl_FragCoord.xy + offset;
        float radius = radius_at(radii, offset.x);
        vec2 towards = direction_at(row, tables.turns[s].xy);
        vec3 ray;
        if (kInGazeFrame) {
            vec3 gaze_ray = gaze_ray_at(radius, towards);
            ray = direct != 0 ? ray_direction(position) : world_from_gaze * gaze_ray;
            position = direct != 0 ? position : position_of(view_from_gaze * gaze_ray);
        } else {
            position = direct != 0 ? position : picture_position(radius, towards);
            ray = ray_direction(position);
        }
        SceneSample seen = scene_sample(SamplePlace(position, eye.camera_and_time.xyz, ray),
                                        eye.camera_and_time.w);
        sum += vec4(seen.radiance, seen.nearness);
    }
    if (!needed) {
        discard;
    }
    color = min(sum / float(kSamples), kGreatestRadiance);
}
