// Where vertices lie. Three rows of each instance's world_from_local.
layout(std430, set = 0, binding = 1) readonly buffer Instances { vec4 instance_rows[]; };

vec3 world_from_local(vec3 p, float w) {
    int row = 3 * gl_InstanceIndex;
    vec4 at = vec4(p, w);
    return vec3(dot(instance_rows[row], at), dot(instance_rows[row + 1], at),
                dot(instance_rows[row + 2], at));
}
