// Pass I of kernel foveated rendering: one cell of the LP-buffer by its own samples; or, for the
// direct disc, one pixel by its own. One shader for both, because software drivers keep few large
// ones compiled.
layout(location = 0) flat in int direct;
layout(location = 0) out vec4 color;

void main() {
    vec3 sum = vec3(0.0);
    for (int s = 0; s < kSamples; ++s) {
        vec4 offset = eye.offsets[s];
        vec2 position = direct != 0 ? gl_FragCoord.xy + offset.xy
                                    : picture_position(ivec2(gl_FragCoord.xy), offset);
        sum += scene_radiance(eye.camera_and_time.xyz, ray_direction(position),
                              eye.camera_and_time.w);
    }
    color = vec4(min(sum / float(kSamples), kGreatestRadiance), 1.0);
}
