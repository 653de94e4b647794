// Pictures are linear until they are written. Where the target's format does not encode by itself
// (UNORM), the pass does it: IEC 61966-2-1.
layout(constant_id = 0) const bool kEncodeSrgb = false;

vec3 encoded(vec3 linear_color) {
    if (!kEncodeSrgb) {
        return linear_color;
    }
    vec3 c = clamp(linear_color, 0.0, 1.0);
    return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThan(c, vec3(0.0031308)));
}
