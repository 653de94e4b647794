// What every scene answers: scene_sample(), stated in scenes/NAME.glsl. What of the answer a pass
// does not use costs nothing: the compiler leaves it out.
struct SamplePlace {
    vec2 position_px;   // in the picture; may lie off screen
    vec3 origin_m;      // of the ray, in world
    vec3 direction;     // unit, in world
    mat2 footprint_px;  // columns: from here to the places of the neighbouring samples
};

const mat2 kPixel = mat2(1.0);  // the footprint of samples that lie a pixel apart

struct SceneSample {
    vec3 radiance;      // linear Rec.709, finite, not negative
    float nearness;     // 1 / distance of what is seen first, 1/m; 0: infinitely far
    vec2 motion_px;     // where it is in this frame less where it was in the last one
};

// A scene of several views (a light field) defines SCENE_OF_VIEWS, and states besides
//   ScenePoint scene_point(SamplePlace)                        what its views are asked for
//   vec3 scene_radiance_of_view(ScenePoint, SceneView)         what one of them shows of it
// so that a method can sum them by weights of its own.
struct SceneView {
    vec2 camera_m;      // its place in the cameras' plane
    float layer;        // of the pictures
    float weight;       // in the sum
};

struct ScenePoint {
    vec2 share;         // of a view's width and height, if its camera stood in the origin
    vec3 point_m;       // in world
    float nearness;     // as of a SceneSample
};

// How far a point that stands still in world has moved in the picture since the last frame. Nothing
// where there is no last frame, and where the point was behind the eye.
vec2 motion_of_still_px(vec2 position_px, vec3 point_m) {
    vec3 from_eye = point_m - eye.last_camera.xyz;
    vec3 local = vec3(dot(eye.last_view_axes[0].xyz, from_eye),
                      dot(eye.last_view_axes[1].xyz, from_eye),
                      dot(eye.last_view_axes[2].xyz, from_eye));
    vec4 t = eye.last_tangents;
    vec2 was = (local.xy / max(-local.z, 1e-6) - t.xz) / (t.yw - t.xz) * image_size();
    return eye.last_camera.w > 0.0 && local.z < 0.0 ? position_px - was : vec2(0.0);
}
