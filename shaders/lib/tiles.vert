#version 460
// One triangle over the whole target, which the scissor cuts down to a tile: two triangles would
// have every block of pixels along their common edge shaded twice. Instance 0 shades texels of the
// LP-buffer, instance 1 pixels of the picture; what more the instance says, the method knows.
layout(location = 0) flat out int direct;

void main() {
    vec2 corner = vec2((gl_VertexIndex << 1) & 2, gl_VertexIndex & 2);
    direct = gl_InstanceIndex;
    gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}
