// The disc of directly shaded pixels, blended across the border inside its radius.
float disc_weight() {
    float radius = map.lp_and_disc.z;
    float border = map.lp_and_disc.w;
    float r = kInGazeFrame ? sqrt(half_sine_squared(gaze_ray(gl_FragCoord.xy)))
                           : distance(gl_FragCoord.xy, map.fovea_and_log2.xy);
    float t = border > 0.0 ? clamp((radius - r) / border, 0.0, 1.0) : float(r < radius);
    return t * t * (3.0 - 2.0 * t);
}

// What the plan left out of either buffer may hold anything, not-a-number too: it is not mixed.
vec4 blended_with_disc(vec4 resolved, vec4 direct) {
    float weight = disc_weight();
    return weight <= 0.0 ? resolved : weight >= 1.0 ? direct : mix(resolved, direct, weight);
}
