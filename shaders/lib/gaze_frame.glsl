// The log-polar map in the gaze's frame (acuity), by the same tables as lib/log_polar.glsl. An
// eccentricity e is measured as sin(e / 2) forward and as rho = tan(e / 2), which the column table
// holds, backward: neither needs trigonometry.
const float kGazeScale = 0.5 / 24.0;  // MapTables::kGazeScale

// sin^2(e / 2) of a ray in the gaze's frame, of any length: in [0, 1], without cancellation.
float half_sine_squared(vec3 ray) {
    float across2 = dot(ray.xy, ray.xy);
    float ray_length = sqrt(across2 + ray.z * ray.z);
    float nearer = 0.5 * across2 / (ray_length * (ray_length + abs(ray.z)));
    return ray.z >= 0.0 ? nearer : 1.0 - nearer;
}

// The ray of a position in the picture, in the gaze's frame.
vec3 gaze_ray(vec2 position_px) {
    return map.gaze_from_picture[0].xyz * position_px.x +
           map.gaze_from_picture[1].xyz * position_px.y + map.gaze_from_picture[2].xyz;
}

// As lp_share in lib/log_polar.glsl.
vec2 gaze_lp_share(vec2 position_px) {
    vec3 ray = gaze_ray(position_px);
    return vec2(column_share(half_sine_squared(ray), kGazeScale), turns(ray.xy));
}

// The unit ray, in the gaze's frame, of a sample at this radius and in this direction.
vec3 gaze_ray_at(float rho, vec2 direction) {
    float rho2 = rho * rho;
    return vec3(2.0 * rho * direction, 1.0 - rho2) / (1.0 + rho2);
}

// The position in the picture of a ray of the view, px. Precondition: it does not lie in the view's
// plane. Only scenes that read a picture of their own (a G-buffer) need it.
vec2 position_of(vec3 view_ray) {
    vec2 tangents = view_ray.xy / -view_ray.z;
    return (tangents - eye.tangents.xz) / (eye.tangents.yw - eye.tangents.xz) * image_size();
}
