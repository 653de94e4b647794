// Log-polar maps by tables: no transcendental function of the driver is called, so that the error
// is the tables' and the same everywhere. map_error.cpp in runtime/foveation/log_polar derives it;
// float_map.cpp mirrors this arithmetic. Here, the map in the picture's frame; gaze_frame.glsl has
// the other.

// What of the map depends on the gaze; the C++ side is foveation/log_polar/map_uniforms.h.
layout(std140, set = 2, binding = 0) uniform MapUniforms {
    vec4 fovea_and_log2;        // fovea, px; log2 of the farthest radius; .5 / that
    vec4 lp_and_disc;           // LP-buffer's width, height; disc radius and its border, px or sin(e/2)
    vec4 radius_and_bands;      // picture frame: farthest radius, px; 1 / its square; LP-buffer's bands
    vec4 gaze_from_picture[3];  // gaze frame: columns; (x_px, y_px, 1) to the gaze's ray
    vec4 view_from_gaze[3];     // gaze frame: columns of its rotation into the view
} map;

// Whether the map is centred by a rotation into the gaze's frame or, in the picture, by a
// translation.
layout(constant_id = 2) const bool kInGazeFrame = false;

const int kMantissaSteps = 512;
const int kForwardSteps = 4096;

// Entry i lies in component i % 4 of element i / 4.
layout(std140, set = 2, binding = 1) uniform MapTables {
    vec4 log2_mantissa[kMantissaSteps / 4 + 1];
    vec4 exp2_fraction[kMantissaSteps / 4 + 1];
    vec4 forward[kForwardSteps / 4 + 1];
    vec4 turns[16];  // samples in their row: cosine, sine of y rows; unused
} tables;
layout(std430, set = 2, binding = 2) readonly buffer ColumnTable { float column_table[]; };
layout(std430, set = 2, binding = 3) readonly buffer RowTable { vec2 row_table[]; };

vec2 lp_size() { return map.lp_and_disc.xy; }

// log2 of a positive, finite float: exponent plus the table at the mantissa's 9 leading bits.
float log2_by_table(float y) {
    uint bits = floatBitsToUint(y);
    int i = int((bits >> 14) & 511u);
    float t = float(bits & 16383u) / 16384.0;
    float low = tables.log2_mantissa[i >> 2][i & 3];
    float high = tables.log2_mantissa[(i + 1) >> 2][(i + 1) & 3];
    return float(int(bits >> 23) - 127) + (low + t * (high - low));
}

// 2^x for x in [-126, 126].
float exp2_by_table(float x) {
    float whole = floor(x);
    float scaled = (x - whole) * float(kMantissaSteps);
    int i = min(int(scaled), kMantissaSteps - 1);
    float low = tables.exp2_fraction[i >> 2][i & 3];
    float high = tables.exp2_fraction[(i + 1) >> 2][(i + 1) & 3];
    return uintBitsToFloat(uint(int(whole) + 127) << 23) *
           (low + (scaled - float(i)) * (high - low));
}

// The column, as a share of the width, of q: the square of a radius over the greatest radius's. The
// table's steps are finest at its far end, where an error moves a pixel the most.
float column_share(float q, float scale) {
    float s = clamp(-log2_by_table(max(q, 1e-30)) * scale, 0.0, 1.0);
    float scaled = sqrt(s) * float(kForwardSteps);
    int i = min(int(scaled), kForwardSteps - 1);
    float low = tables.forward[i >> 2][i & 3];
    float high = tables.forward[(i + 1) >> 2][(i + 1) & 3];
    return low + (scaled - float(i)) * (high - low);
}

// The column table's values at a column's inner edge, centre and outer edge.
vec3 column_values(int column) {
    return vec3(column_table[2 * column], column_table[2 * column + 1],
                column_table[2 * column + 2]);
}

// A sample's radius: on the parabola through those of its column.
float radius_at(vec3 radii, float offset) {
    float bend = 2.0 * (radii.x + radii.z - 2.0 * radii.y);
    return radii.y + offset * (radii.z - radii.x + offset * bend);
}

// A sample's direction from that of its row's centre; turn as the tables have it.
vec2 direction_at(vec2 row, vec2 turn) {
    return vec2(row.x * turn.x - row.y * turn.y, row.y * turn.x + row.x * turn.y);
}

// The angle of a direction in turns, [0, 1]; 0 for the null vector. Odd polynomial in the smaller
// over the greater component, least-maximum fit, error under 2.3e-8 turns in float.
float turns(vec2 d) {
    vec2 a = abs(d);
    float greater = max(a.x, a.y);
    float q = greater > 0.0 ? min(a.x, a.y) / greater : 0.0;
    float z = q * q;
    float p = 0.00039099999997;
    p = p * z - 0.00229204795323;
    p = p * z + 0.00633137952536;
    p = p * z - 0.01151463389397;
    p = p * z + 0.01670959219337;
    p = p * z - 0.02253829687834;
    p = p * z + 0.03180855885148;
    p = p * z - 0.05305047705770;
    p = p * z + 0.15915492177010;
    p *= q;
    p = a.y > a.x ? 0.25 - p : p;
    p = d.x < 0.0 ? 0.5 - p : p;
    return d.y < 0.0 ? 1.0 - p : p;
}

// Where the LP-buffer holds a position of the picture, as shares of its width and height; row 1 is
// row 0.
vec2 lp_share(vec2 position_px) {
    vec2 d = position_px - map.fovea_and_log2.xy;
    return vec2(column_share(dot(d, d) * map.radius_and_bands.y, map.fovea_and_log2.w), turns(d));
}

// The radii of a column's inner edge, centre and outer edge, px.
vec3 column_radii(int column) {
    vec3 x = -column_values(column) * map.fovea_and_log2.z;
    return map.radius_and_bands.x * vec3(exp2_by_table(x.x), exp2_by_table(x.y), exp2_by_table(x.z));
}

// The position in the picture of a sample at this radius, px, and in this direction.
vec2 picture_position(float radius, vec2 direction) {
    return map.fovea_and_log2.xy + radius * direction;
}
