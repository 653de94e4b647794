#version 460
#extension GL_GOOGLE_include_directive : require
// Layers: every pixel from the layers around it, interpolated in linear light, each blended into
// the next coarser one. A layer that was kept from the last frame is read where its view showed
// what this pixel shows.
#include "../lib/frame.glsl"
#include "../lib/layers.glsl"
#include "../lib/encode.glsl"
#include "../lib/depth.glsl"

layout(constant_id = 4) const int kLayers = 3;
// Which layers were kept from the last frame, by bits; a constant, since a kept layer costs twice
// what a fresh one does.
layout(constant_id = 5) const int kKept = 0;
layout(set = 2, binding = 2) uniform sampler2D layer_1;
layout(set = 2, binding = 3) uniform sampler2D layer_2;
layout(set = 2, binding = 4) uniform sampler2D layer_3;
layout(set = 2, binding = 5) uniform sampler2D layer_4;
layout(location = 0) out vec4 color;

// Where in the last picture a layer that was kept shows what this ray meets. How far away that is,
// only the layer itself knows: first as if infinitely.
vec2 kept_position(sampler2D image, SeenLayer shown, vec3 ray) {
    vec2 position = position_in(shown, shown.camera.xyz + 1e6 * ray);
    for (int i = 0; i < 2; ++i) {
        ivec2 cell = clamp(ivec2(cell_position(shown, position)), ivec2(0),
                           max(ivec2(shown.cells.xy) - 1, ivec2(0)));
        float nearness = texelFetch(image, cell, 0).a;
        position = position_in(shown, eye.camera_and_time.xyz + ray / max(nearness, 1e-6));
    }
    return position;
}

// A layer over those that are coarser. Nothing of it is read far from its gaze: that is a loop of one
// turn or none, which lavapipe leaves where it would mask a branch.
vec4 composed(vec4 under, sampler2D image, int layer, bool outermost, vec3 ray) {
    SeenLayer shown = layers.shown[layer];
    float half_sine = 0.5 * distance(ray, shown.gaze.xyz);
    float around_gaze = (shown.blend.x - half_sine) * shown.blend.y;
    int turns = outermost || (shown.gaze.w > 0.0 && around_gaze > 0.0) ? 1 : 0;
    vec4 over = under;
    for (int turn = 0; turn < turns; ++turn) {
        vec2 position =
            ((kKept >> layer) & 1) != 0 ? kept_position(image, shown, ray) : gl_FragCoord.xy;
        vec4 inner = interpolated(image, cell_position(shown, position), shown.cells.xy);
        vec2 low = (position - shown.covers.xy) * shown.blend.zw;
        vec2 high = (shown.covers.xy + shown.covers.zw - position) * shown.blend.zw;
        // At the picture's edges a layer has none of its own.
        low = mix(low, vec2(1.0), lessThanEqual(shown.covers.xy, vec2(0.0)));
        high = mix(high, vec2(1.0),
                   greaterThanEqual(shown.covers.xy + shown.covers.zw, image_size()));
        float within = min(around_gaze, min(min(low.x, low.y), min(high.x, high.y)));
        float t = clamp(within, 0.0, 1.0);
        float weight = outermost ? 1.0 : shown.gaze.w * t * t * (3.0 - 2.0 * t);
        over = weight <= 0.0 ? under : weight >= 1.0 ? inner : mix(under, inner, weight);
    }
    return over;
}

// The outermost layer of a view is the whole picture; those beyond it hold nothing.
bool is_outermost(int layer) {
    return layer == kLayers - 1 || layers.shown[min(layer + 1, kMostLayers - 1)].cells.x <= 0.0;
}

void main() {
    vec3 ray = ray_direction(gl_FragCoord.xy);
    vec4 shown = vec4(0.0);
    if (kLayers > 3) {
        shown = composed(shown, layer_4, 3, true, ray);
    }
    if (kLayers > 2) {
        shown = composed(shown, layer_3, 2, is_outermost(2), ray);
    }
    if (kLayers > 1) {
        shown = composed(shown, layer_2, 1, is_outermost(1), ray);
    }
    shown = composed(shown, layer_1, 0, is_outermost(0), ray);
    color = vec4(encoded(shown.rgb), 1.0);
    set_depth(gl_FragCoord.xy, shown.a);
}
