// Full resolution: every pixel by its own samples.
layout(location = 0) out vec4 color;

void main() {
    vec4 sum = vec4(0.0);
    for (int s = 0; s < kSamples; ++s) {
        vec2 position = gl_FragCoord.xy + eye.offsets[s].xy;
        sum += scene_radiance(eye.camera_and_time.xyz, ray_direction(position),
                              eye.camera_and_time.w);
    }
    sum /= float(kSamples);
    color = vec4(encoded(min(sum.rgb, kGreatestRadiance)), 1.0);
    set_depth(gl_FragCoord.xy, sum.a);
}
