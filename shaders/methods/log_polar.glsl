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

// The rotation by a share of a row's height, as cosine and sine: by series, since that of a driver
// may be off by pixels.
vec2 turn_by(float rows) {
    float a = rows * (6.28318531 / lp_size().y);
    float a2 = a * a;
    return vec2(1.0 - a2 * (0.5 - a2 * (1.0 / 24.0 - a2 / 720.0)),
                a * (1.0 - a2 * (1.0 / 6.0 - a2 * (1.0 / 120.0 - a2 / 5040.0))));
}

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
    // Neighbouring cells lie beside each other in the target too.
    vec2 centre = kInGazeFrame ? position_of(view_from_gaze * gaze_ray_at(radii.y, row))
                               : picture_position(radii.y, row);
    vec2 next_column = dFdx(centre);
    vec2 next_row = dFdy(centre);
    mat2 footprint = direct != 0 ? kPixel : mat2(next_column, next_row);
    int samples = needed ? kSamples : 0;
    vec4 sum = vec4(0.0);
    for (int s = 0; s < samples; ++s) {
        vec2 offset = eye.offsets[s].xy;
        vec2 turn = tables.turns[s].xy;
        if (kJittered) {
            offset += eye.image.zw;
            turn = direction_at(turn, turn_by(eye.image.w));
        }
        vec2 position = gl_FragCoord.xy + offset;
        float radius = radius_at(radii, offset.x);
        vec2 towards = direction_at(row, turn);
        vec3 ray;
        if (kInGazeFrame) {
            vec3 gaze_ray = gaze_ray_at(radius, towards);
            ray = direct != 0 ? ray_direction(position) : world_from_gaze * gaze_ray;
            position = direct != 0 ? position : position_of(view_from_gaze * gaze_ray);
        } else {
            position = direct != 0 ? position : picture_position(radius, towards);
            ray = ray_direction(position);
        }
        SceneSample seen = scene_sample(SamplePlace(position, eye.camera_and_time.xyz, ray, footprint),
                                        eye.camera_and_time.w);
        sum += vec4(seen.radiance, seen.nearness);
    }
    if (!needed) {
        discard;
    }
    color = min(sum / float(kSamples), kGreatestRadiance);
}
