// A light field: pictures of something from a grid of cameras in the plane z = 0, all looking along
// -Z. A picture of it is that of a thin lens in that plane: each ray meets the focal plane, and what
// the views in the lens show of that point is summed by weight. Beyond what a view shows it is black,
// as through a window. Nearness is that of the focal plane: views know no other.
//
// A scene of several views: it also states what one of them adds (lib/scene.glsl), for methods that
// take some views here and some there. The C++ side is runtime/scene/light_field_scene.cpp.
#define SCENE_OF_VIEWS

layout(set = 1, binding = 0) uniform sampler2DArray light_field;
layout(std430, set = 1, binding = 1) readonly buffer LensViews {
    vec4 focal_plane;   // its distance, m; shares of a view's width and height per metre on it; unused
    uvec4 lens_count;   // of the views below; unused
    SceneView lens_views[];
};

ScenePoint scene_point(SamplePlace place) {
    // Rays that do not go forward meet the plane so far aside that no view shows it.
    float forward = max(-place.direction.z, 1e-4);
    float along_m = max(place.origin_m.z + focal_plane.x, 1e-3) / forward;
    vec3 point_m = place.origin_m + along_m * place.direction;
    vec2 share = clamp(0.5 + vec2(point_m.x, -point_m.y) * focal_plane.yz, -1e6, 1e6);
    return ScenePoint(share, point_m, 1.0 / along_m);
}

vec3 scene_radiance_of_view(ScenePoint point, SceneView view) {
    vec2 moved = vec2(-view.camera_m.x, view.camera_m.y) * focal_plane.yz;
    // The level is stated: derivatives jump where neighbouring samples are not neighbours.
    return textureLod(light_field, vec3(point.share + moved, view.layer), 0.0).rgb;
}

SceneSample scene_sample_at(SamplePlace place, ScenePoint point, vec3 radiance) {
    return SceneSample(radiance, point.nearness,
                       motion_of_still_px(place.position_px, point.point_m));
}

SceneSample scene_sample(SamplePlace place, float time_s) {
    ScenePoint point = scene_point(place);
    vec3 sum = vec3(0.0);
    // Of a buffer, no uniform: lavapipe 22.3 would compile the loop anew for every draw.
    uint count = lens_count.x;
    for (uint i = 0u; i < count; ++i) {
        sum += lens_views[i].weight * scene_radiance_of_view(point, lens_views[i]);
    }
    return scene_sample_at(place, point, sum);
}
