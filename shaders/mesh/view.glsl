// What the passes before the gaze know of a view: an eye's or a light's. The C++ side is
// runtime/scene/mesh_uniforms.h.
layout(std140, set = 0, binding = 0) uniform ViewUniforms {
    mat4 clip_from_world;   // depth is near / distance along the axis for eyes
    vec4 camera;            // m, world
    vec4 axes[3];           // columns of the view's rotation into world
    vec4 tangents;          // of the field of view: left, right, up, down
    vec4 size;              // width, height, px; unused
    vec4 to_sun;            // unit; cosine of the disc's radius
    vec4 sun;               // radiance of its disc; unused
} view;
