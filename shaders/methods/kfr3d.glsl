// Pass I of 3D-KFR: shades one texel of a region's LP-buffer by that region's views, or, for the
// direct disc, one pixel by all of them. What each adds is summed over the regions by the resolve.
// A scene without views is one of a single view, which is the foveal region's.
#include "../lib/log_polar.glsl"
#include "../lib/bands.glsl"
#include "../lib/view_regions.glsl"

layout(location = 0) flat in int part;  // a region; kMostRegions: the disc
layout(location = 0) out vec4 color;

vec4 sum_of_views(SamplePlace place, uint first, uint end) {
    vec4 sum = vec4(0.0);
#ifdef SCENE_OF_VIEWS
    ScenePoint point = scene_point(place);
    for (uint i = first; i < end; ++i) {
        SceneView view = view_at(i);
        sum += view.weight * vec4(scene_radiance_of_view(point, view), point.nearness);
    }
#else
    for (uint i = first; i < end; ++i) {
        SceneSample seen = scene_sample(place, eye.camera_and_time.w);
        sum += vec4(seen.radiance, seen.nearness);
    }
#endif
    return sum;
}

void main() {
    uvec2 cell = uvec2(gl_FragCoord.xy);
    bool direct = part == kMostRegions;
    bool needed = is_needed(cell, direct ? uint(map.radius_and_bands.z) : 0u);
    uint first = direct ? 0u : region_views[part];
    uint end = region_views[direct ? part : part + 1];
    int column = min(int(cell.x), int(lp_size().x) - 1);
    vec2 row = row_table[min(int(cell.y), int(lp_size().y) - 1)];
    vec3 radii = column_radii(column);
    int samples = needed ? kSamples : 0;
    vec4 sum = vec4(0.0);
    for (int s = 0; s < samples; ++s) {
        vec2 offset = eye.offsets[s].xy;
        vec2 in_map = picture_position(radius_at(radii, offset.x),
                                       direction_at(row, tables.turns[s].xy));
        vec2 position = direct ? gl_FragCoord.xy + offset : in_map;
        sum += sum_of_views(
            SamplePlace(position, eye.camera_and_time.xyz, ray_direction(position), kPixel), first,
            end);
    }
    if (!needed) {
        discard;
    }
    color = min(sum / float(kSamples), kGreatestRadiance);
}
