// Signed distances to the primitives of the ray-marched scene.
//
// Every function takes a point in the primitive's own frame (metres; axis of revolution or
// extrusion along Y unless it says otherwise) and returns metres, negative inside. "Exact" is the
// Euclidean distance; "bound" never exceeds it, so that a march along it cannot step through the
// surface.
#ifndef GAZELOOP_RAYMARCH_SHAPES_GLSL
#define GAZELOOP_RAYMARCH_SHAPES_GLSL

// Joins the distance to a 2D profile with the distance to the two end planes. Exact if both are.
float distance_to_extrusion(float profile_m, float height_m) {
    vec2 outside = max(vec2(profile_m, height_m), 0.0);
    return length(outside) + min(max(profile_m, height_m), 0.0);
}

// Exact.
float distance_to_plane(vec3 p, float height_m) { return p.y - height_m; }

// Exact.
float distance_to_sphere(vec3 p, float radius_m) { return length(p) - radius_m; }

// Exact.
float distance_to_box(vec3 p, vec3 half_size_m) {
    vec3 q = abs(p) - half_size_m;
    return length(max(q, 0.0)) + min(max(q.x, max(q.y, q.z)), 0.0);
}

// Exact down to -radius_m, which is as deep as it goes. half_size_m includes the rounding.
float distance_to_rounded_box(vec3 p, vec3 half_size_m, float radius_m) {
    return length(max(abs(p) - (half_size_m - radius_m), 0.0)) - radius_m;
}

// The twelve edges of a box as bars with rounded edges. Exact down to -radius_m, which is as deep
// as it goes.
float distance_to_box_frame(vec3 p, vec3 half_size_m, float bar_half_m, float radius_m) {
    p = abs(p);
    vec3 past_face = max(p - (half_size_m - radius_m), 0.0);
    vec3 past_bar = max(abs(p - (half_size_m - bar_half_m)) - (bar_half_m - radius_m), 0.0);
    vec3 face_sq = past_face * past_face;
    vec3 bar_sq = past_bar * past_bar;
    // A bar is free to run the whole length of one axis and is pinned in the two others.
    float nearest_sq = min(face_sq.x + bar_sq.y + bar_sq.z,
                           min(bar_sq.x + face_sq.y + bar_sq.z, bar_sq.x + bar_sq.y + face_sq.z));
    return sqrt(nearest_sq) - radius_m;
}

// Exact.
float distance_to_cylinder(vec3 p, float radius_m, float half_height_m) {
    return distance_to_extrusion(length(p.xz) - radius_m, abs(p.y) - half_height_m);
}

// A segment from the origin to (0, height_m, 0), thickened. Exact.
float distance_to_capsule(vec3 p, float height_m, float radius_m) {
    p.y -= clamp(p.y, 0.0, height_m);
    return length(p) - radius_m;
}

// A sphere that shrinks from base_m to tip_m as it is swept from the origin to (0, height_m, 0);
// needs 0 <= base_m - tip_m < height_m. Exact: |p - c(h)| - r(h) is convex in h, and least where
// the line from the centre to the point stands square on the slanted side.
float distance_to_round_cone(vec3 p, float height_m, float base_m, float tip_m) {
    float taper = (base_m - tip_m) / height_m;
    float slope = taper * inversesqrt(1.0 - taper * taper);
    vec2 q = vec2(length(p.xz), p.y);
    float h = clamp(q.y - slope * q.x, 0.0, height_m);
    return length(q - vec2(0.0, h)) - (base_m - taper * h);
}

// Tip at the origin, opening downwards without end (it stands in something); profile is the unit
// direction (outwards, downwards) of its side. Exact.
float distance_to_cone(vec3 p, vec2 profile) {
    vec2 q = vec2(length(p.xz), -p.y);
    float along = dot(q, profile);
    float across = q.x * profile.y - q.y * profile.x;
    return along > 0.0 ? across : length(q);
}

// Four-sided, tip at the origin, opening downwards without end; profile is the unit direction
// (outwards, downwards) of the middle of a face. Exact.
float distance_to_pyramid(vec3 p, vec2 profile) {
    // Folded into the eighth around +X: the face that spans (along, side), height across above it.
    float outwards = max(abs(p.x), abs(p.z));
    float side = min(abs(p.x), abs(p.z));
    float along = outwards * profile.x - p.y * profile.y;
    float across = outwards * profile.y + p.y * profile.x;
    vec2 edge = vec2(1.0, profile.x) * inversesqrt(1.0 + profile.x * profile.x);
    vec2 on_edge = edge * max(along * edge.x + side * edge.y, 0.0);
    vec2 off_edge = vec2(along, side) - on_edge;
    return side <= along * profile.x ? across : sqrt(dot(off_edge, off_edge) + across * across);
}

// Exact.
float distance_to_torus(vec3 p, float ring_m, float tube_m) {
    return length(vec2(length(p.xz) - ring_m, p.y)) - tube_m;
}

// An arc of a torus in the XY plane, symmetric about +Y; end is the unit direction (x >= 0) of its
// right end. Exact.
float distance_to_capped_torus(vec3 p, vec2 end, float ring_m, float tube_m) {
    p.x = abs(p.x);
    float towards = end.y * p.x > end.x * p.y ? dot(p.xy, end) : length(p.xy);
    return sqrt(max(dot(p, p) + ring_m * ring_m - 2.0 * ring_m * towards, 0.0)) - tube_m;
}

// A torus in the XY plane, cut in half and pulled apart along Y by 2 * half_straight_m. Exact.
float distance_to_link(vec3 p, float half_straight_m, float ring_m, float tube_m) {
    p.y = max(abs(p.y) - half_straight_m, 0.0);
    return length(vec2(length(p.xy) - ring_m, p.z)) - tube_m;
}

// Bound: for a convex function, value over slope underestimates the way to its zero.
float distance_to_ellipsoid(vec3 p, vec3 semi_axis_m) {
    vec3 q = p / semi_axis_m;
    float value = length(q);
    return value * (value - 1.0) / max(length(q / semi_axis_m), 1e-6);
}

// Bound, exact over the faces.
float distance_to_octahedron(vec3 p, float tip_m) {
    p = abs(p);
    return (p.x + p.y + p.z - tip_m) * 0.57735027;
}

// Bound, exact over the faces; apothem_m is the distance of a side from the axis.
float distance_to_hexagonal_prism(vec3 p, float apothem_m, float half_height_m) {
    p = abs(p);
    float hexagon = max(0.8660254 * p.x + 0.5 * p.z, p.z) - apothem_m;
    return distance_to_extrusion(hexagon, p.y - half_height_m);
}

// Bound, exact over the faces; one side looks to -Z.
float distance_to_triangular_prism(vec3 p, float apothem_m, float half_height_m) {
    float triangle = max(0.8660254 * abs(p.x) + 0.5 * p.z, -p.z) - apothem_m;
    return distance_to_extrusion(triangle, abs(p.y) - half_height_m);
}

#endif
