// Full resolution: every pixel by its own samples.
layout(location = 0) out vec4 color;

void main() {
    vec4 sum = vec4(0.0);
    for (int s = 0; s < kSamples; ++s) {
        vec2 position = gl_FragCoord.xy + eye.offsets[s].xy;
        if (kJittered) {
            position += eye.image.zw;
        }
        SceneSample seen = scene_sample(
            SamplePlace(position, eye.camera_and_time.xyz, ray_direction(position), kPixel),
            eye.camera_and_time.w);
        sum += vec4(seen.radiance, seen.nearness);
    }
    sum /= float(kSamples);
    color = vec4(encoded(min(sum.rgb, kGreatestRadiance)), 1.0);
    set_depth(gl_FragCoord.xy, sum.a);
}
