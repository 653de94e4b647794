// Layers around the gaze: each a rectangle of the picture, shaded at a resolution of its own. The
// C++ side is LayerUniforms in runtime/render/passes/layers_passes.cpp.
const int kMostLayers = 4;

// A layer as it was shaded last.
struct SeenLayer {
    vec4 covers;    // x0, y0, width, height, px of the picture
    vec4 cells;     // width, height; the sample's place in every cell: x, y in (-.5, .5)
    vec4 blend;     // where nothing is shown of it, as sin(e / 2); how much per unit inside; per px
                    // from its edges: x, y
    vec4 gaze;      // unit, in world; 1, or 0 where it holds nothing
    vec4 camera;    // eye position in world, m; unused
    vec4 axes[3];   // columns of the view's rotation into world
    vec4 tangents;  // of the field of view: left, right, up, down
};

layout(std140, set = 2, binding = 0) uniform LayerUniforms {
    SeenLayer shown[kMostLayers];   // what the picture is made of
    SeenLayer before[kMostLayers];  // the time before that, for those shaded in this frame
    vec4 first_band;                // of each layer in the table
} layers;

// Columns of cells that a plan needs, by 4 rows, layer after layer.
layout(std430, set = 2, binding = 1) readonly buffer LayerBands { uvec2 layer_bands[]; };

// Where a layer's view shows a point, px of its picture; far beyond it where that is behind.
vec2 position_in(SeenLayer layer, vec3 point_m) {
    vec3 from_eye = point_m - layer.camera.xyz;
    vec3 local = vec3(dot(layer.axes[0].xyz, from_eye), dot(layer.axes[1].xyz, from_eye),
                      dot(layer.axes[2].xyz, from_eye));
    vec2 tangents = local.xy / max(-local.z, 1e-6);
    return (tangents - layer.tangents.xz) / (layer.tangents.yw - layer.tangents.xz) * image_size();
}

// In cells; centres of cells at +.5.
vec2 cell_position(SeenLayer layer, vec2 position_px) {
    return (position_px - layer.covers.xy) / layer.covers.zw * layer.cells.xy;
}

// By hand, so that no cell beyond the layer's is read: it may hold anything.
vec4 interpolated(sampler2D image, vec2 position, vec2 size) {
    vec2 inside = clamp(position, vec2(0.5), max(size - 0.5, vec2(0.5)));
    vec2 corner = floor(inside - 0.5);
    vec2 share = inside - 0.5 - corner;
    ivec2 low = ivec2(corner);
    ivec2 high = min(low + 1, max(ivec2(size) - 1, ivec2(0)));
    return mix(mix(texelFetch(image, low, 0), texelFetch(image, ivec2(high.x, low.y), 0), share.x),
               mix(texelFetch(image, ivec2(low.x, high.y), 0), texelFetch(image, high, 0), share.x),
               share.y);
}
