// Pass I of kernel foveated rendering: one cell of the LP-buffer by its own samples; or, for the
// direct disc, one pixel by its own. One shader for both, because software drivers keep few large
// ones compiled. Cells of a tile that the plan leaves out take no samples and keep what they held;
// they are discarded last, because lavapipe 22.3 is a fifth slower where loops follow a discard.
layout(location = 0) flat in int direct;
layout(location = 0) out vec4 color;

void main() {
    uvec2 cell = uvec2(gl_FragCoord.xy);
    bool needed = is_needed(cell, direct != 0 ? uint(eye.image_and_bands.z) : 0u);
    vec3 radii = column_radii(min(int(cell.x), int(lp_size().x) - 1));
    vec2 row_direction = row_table[min(int(cell.y), int(lp_size().y) - 1)];
    int samples = needed ? kSamples : 0;
    vec3 sum = vec3(0.0);
    for (int s = 0; s < samples; ++s) {
        vec4 offset = eye.offsets[s];
        vec2 position = direct != 0 ? gl_FragCoord.xy + offset.xy
                                    : picture_position(radii, row_direction, offset);
        sum += scene_radiance(eye.camera_and_time.xyz, ray_direction(position),
                              eye.camera_and_time.w);
    }
    if (!needed) {
        discard;
    }
    color = vec4(min(sum / float(kSamples), kGreatestRadiance), 1.0);
}
