// The kernel log-polar map by tables: no transcendental function of the driver is called, so that
// the error is the tables' and the same everywhere (runtime/foveation/map_tables.h derives it).
const int kMantissaSteps = 512;
const int kKernelSteps = 4096;

// Entry i lies in component i % 4 of element i / 4.
layout(std140, set = 0, binding = 1) uniform MapTables {
    vec4 log2_mantissa[kMantissaSteps / 4 + 1];
    vec4 exp2_fraction[kMantissaSteps / 4 + 1];
    vec4 kernel[kKernelSteps / 4 + 1];
} tables;
layout(std430, set = 0, binding = 2) readonly buffer ColumnTable { float column_table[]; };
layout(std430, set = 0, binding = 3) readonly buffer RowTable { vec2 row_table[]; };

vec2 lp_size() { return eye.lp_and_disc.xy; }

// log2 of a positive, finite float: exponent plus the table at the mantissa's 9 leading bits.
float log2_by_table(float y) {
    uint bits = floatBitsToUint(y);
    int i = int((bits >> 14) & 511u);
    float t = float(bits & 16383u) / 16384.0;
    float low = tables.log2_mantissa[i >> 2][i & 3];
    float high = tables.log2_mantissa[(i + 1) >> 2][(i + 1) & 3];
    return float(int(bits >> 23) - 127) + mix(low, high, t);
}

// 2^x for x in [0, 126].
float exp2_by_table(float x) {
    float whole = floor(x);
    float scaled = (x - whole) * float(kMantissaSteps);
    int i = min(int(scaled), kMantissaSteps - 1);
    float low = tables.exp2_fraction[i >> 2][i & 3];
    float high = tables.exp2_fraction[(i + 1) >> 2][(i + 1) & 3];
    return uintBitsToFloat(uint(int(whole) + 127) << 23) * mix(low, high, scaled - float(i));
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

// Where the LP-buffer holds a position of the picture: columns [0, w], rows [0, h]; row h is row 0.
vec2 lp_position(vec2 position_px) {
    vec2 d = position_px - eye.fovea_and_log2.xy;
    float r2 = dot(d, d);
    float x = clamp(log2_by_table(max(r2, 1.0)) * eye.fovea_and_log2.w, 0.0, 1.0);
    float scaled = x * float(kKernelSteps);
    int i = min(int(scaled), kKernelSteps - 1);
    float low = tables.kernel[i >> 2][i & 3];
    float high = tables.kernel[(i + 1) >> 2][(i + 1) & 3];
    return vec2(mix(low, high, scaled - float(i)), turns(d)) * lp_size();
}

// The radii of a column's inner edge, centre and outer edge.
vec3 column_radii(int column) {
    vec3 x = vec3(column_table[2 * column], column_table[2 * column + 1],
                  column_table[2 * column + 2]) * eye.fovea_and_log2.z;
    return vec3(exp2_by_table(x.x), exp2_by_table(x.y), exp2_by_table(x.z));
}

// The position of a sample in an LP texel, from its column's radii (the parabola through them) and
// its row's direction; offset as EyeUniforms has it.
vec2 picture_position(vec3 radii, vec2 row_direction, vec4 offset) {
    float bend = 2.0 * (radii.x + radii.z - 2.0 * radii.y);
    float r = radii.y + offset.x * (radii.z - radii.x + offset.x * bend);
    vec2 direction = vec2(row_direction.x * offset.z - row_direction.y * offset.w,
                          row_direction.y * offset.z + row_direction.x * offset.w);
    return eye.fovea_and_log2.xy + r * direction;
}
