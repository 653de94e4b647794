// Reads of an LP-buffer at places that a plan did not foresee, for lib/log_polar.glsl and
// lib/bands.glsl: between the texels around, without those that the plan leaves out. They may hold
// anything, not-a-number too; what they would have weighed the others share.
struct LpRead {
    vec4 sum;      // of what the texels hold, weighed
    float weight;  // of them all, [0, 1]
};

// `at` as lp_share() in lib/log_polar.glsl has it, give or take a texel.
LpRead lp_read(sampler2D lp_buffer, vec2 at) {
    ivec2 size = ivec2(lp_size());
    vec2 place = at * lp_size() - 0.5;
    vec2 corner = floor(place);
    vec2 share = place - corner;
    LpRead read = LpRead(vec4(0.0), 0.0);
    for (int tap = 0; tap < 4; ++tap) {
        ivec2 aside = ivec2(tap & 1, tap >> 1);
        ivec2 texel = ivec2(corner) + aside;
        texel = ivec2(clamp(texel.x, 0, size.x - 1), (texel.y + size.y) % size.y);
        vec2 part = mix(1.0 - share, share, vec2(aside));
        float weight = is_needed(uvec2(texel), 0u) ? part.x * part.y : 0.0;
        read.sum += weight > 0.0 ? weight * texelFetch(lp_buffer, texel, 0) : vec4(0.0);
        read.weight += weight;
    }
    return read;
}
