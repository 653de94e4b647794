#version 460
#extension GL_GOOGLE_include_directive : require
// Internal antialiasing (Meng et al. 2018, 3.1): a 3 x 3 Gaussian over the LP-buffer's outer
// columns, before the resolve. Rows wrap, columns end. Cells that the plan leaves out may hold
// anything, not-a-number too: they take no part, and what they would have weighed the others share.
#include "../lib/frame.glsl"
#include "../lib/log_polar.glsl"
#include "../lib/bands.glsl"

layout(set = 2, binding = 5) uniform sampler2D lp_buffer;
layout(location = 0) out vec4 filtered;

// Shares of the width between which the filter fades in: inside, texels are finer than pixels.
const float kFrom = 0.25;
const float kWhole = 0.5;

void main() {
    ivec2 cell = ivec2(gl_FragCoord.xy);
    ivec2 size = ivec2(lp_size());
    vec4 centre = texelFetch(lp_buffer, cell, 0);
    uvec2 needed = needed_columns(uint(cell.y), 0u);
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int dy = -1; dy <= 1; ++dy) {
        int row = cell.y + dy;
        row = row < 0 ? size.y - 1 : row >= size.y ? 0 : row;
        // Read once for each row: a storage buffer costs software drivers as much as a few texels.
        uvec2 columns = needed_columns(uint(row), 0u);
        for (int dx = -1; dx <= 1; ++dx) {
            ivec2 other = ivec2(clamp(cell.x + dx, 0, size.x - 1), row);
            float weight = float((2 - abs(dx)) * (2 - abs(dy)));
            bool counts = is_within(uint(other.x), columns);
            sum += counts ? weight * texelFetch(lp_buffer, other, 0).rgb : vec3(0.0);
            weights += counts ? weight : 0.0;
        }
    }
    float share = smoothstep(kFrom, kWhole, (float(cell.x) + 0.5) / lp_size().x);
    vec3 smoothed = weights > 0.0 ? sum / weights : centre.rgb;
    // Its distance a cell keeps: between two distances there is nothing.
    filtered = vec4(mix(centre.rgb, smoothed, share), centre.a);
    if (!is_within(uint(cell.x), needed)) {
        discard;
    }
}
