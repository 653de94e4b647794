// Scenes of triangle meshes: lights what the G-buffer shows at a place of the picture, by whatever
// method asks. Positions off screen show the nearest pixel.
//
// radiance   GGX with several lights and shadows, light from the sky, screen-space reflections and
//            refraction, ambient occlusion. What the scene does not need is compiled out.
// motion     that of the head: nothing in the scene moves by itself.
//
// Needs lib/scene.glsl; its inputs are set 1 (runtime/scene/mesh_uniforms.h).
#ifndef GAZELOOP_MESH_GLSL
#define GAZELOOP_MESH_GLSL

#include "../lib/g_buffer.glsl"

layout(constant_id = 16) const int kShadowLights = 0;     // the first ones, with maps
layout(constant_id = 17) const int kPlainLights = 0;      // after those
layout(constant_id = 18) const bool kHasGlass = false;    // a second G-buffer in front
layout(constant_id = 19) const int kReflectionSteps = 0;  // 0: reflections show the sky alone
layout(constant_id = 20) const int kOcclusionTaps = 0;    // [0, 8]
layout(constant_id = 21) const bool kFootprint = false;   // surfaces over a sample's footprint

const int kMostLights = 16;
const int kMostShadowMaps = 8;
const float kNear_m = 0.05;         // G-buffer depth is kNear_m / distance along the view's axis
const float kSkyLevels = 6.0;
const float kPi = 3.14159265;
const float kLeastAlpha = 0.002;    // of lights without size: a mirror shows none
const float kGlossy = 0.35;         // roughness from which reflections show the sky alone

struct SceneLight {
    vec4 place;    // position, m, 1; or the way to it, 0
    vec4 axis;     // unit, the way that it goes; 1 / range^2, or 0
    vec4 color;    // candela or lux; unused
    vec4 shape;    // cone: scale and offset of the cosine; its nearer and its wider shadow map
};

layout(std140, set = 1, binding = 0) uniform MeshUniforms {
    SceneLight lights[kMostLights];
    mat4 shadow_from_world[kMostShadowMaps];
    vec4 shadow_texels[kMostShadowMaps];  // width of a texel at 1 m (or everywhere), m; per m
    vec4 sky_diffuse[9];
    vec4 more;  // exposure; 1 / size of a shadow map, texels; unused
} mesh;
layout(set = 1, binding = 1) uniform usampler2D g_buffer;
layout(set = 1, binding = 2) uniform sampler2D g_depth;
layout(set = 1, binding = 3) uniform usampler2D glass_buffer;
layout(set = 1, binding = 4) uniform sampler2D glass_depth;
layout(set = 1, binding = 5) uniform sampler2DArray shadow_maps;
layout(set = 1, binding = 6) uniform samplerCube sky;

// Along the ray of a position, 1 m further along the view's axis.
vec3 ray_per_axis_m(vec2 position_px) {
    vec2 at = position_px / image_size();
    return view_to_world(vec3(mix(eye.tangents.x, eye.tangents.y, at.x),
                              mix(eye.tangents.z, eye.tangents.w, at.y), -1.0));
}

// Position, px, and distance along the view's axis, m, of a point in world.
vec3 seen_at(vec3 point_m) {
    vec3 from_eye = point_m - eye.camera_and_time.xyz;
    float ahead = -dot(eye.view_axes[2].xyz, from_eye);
    vec2 across = vec2(dot(eye.view_axes[0].xyz, from_eye), dot(eye.view_axes[1].xyz, from_eye));
    vec2 at = (across / max(ahead, 1e-4) - eye.tangents.xz) / (eye.tangents.yw - eye.tangents.xz);
    return vec3(at * image_size(), ahead);
}

ivec2 texel_at(vec2 position_px) {
    return clamp(ivec2(floor(position_px)), ivec2(0), ivec2(image_size()) - 1);
}

vec3 point_at(ivec2 texel, float depth) {
    return eye.camera_and_time.xyz +
           ray_per_axis_m(vec2(texel) + 0.5) * (kNear_m / max(depth, 1e-7));
}

vec3 sky_diffuse_at(vec3 n) {
    return max(vec3(0.0),
               0.282095 * mesh.sky_diffuse[0].rgb +
                   0.488603 * (n.y * mesh.sky_diffuse[1].rgb + n.z * mesh.sky_diffuse[2].rgb +
                               n.x * mesh.sky_diffuse[3].rgb) +
                   1.092548 * (n.x * n.y * mesh.sky_diffuse[4].rgb +
                               n.y * n.z * mesh.sky_diffuse[5].rgb +
                               n.x * n.z * mesh.sky_diffuse[7].rgb) +
                   0.315392 * (3.0 * n.z * n.z - 1.0) * mesh.sky_diffuse[6].rgb +
                   0.546274 * (n.x * n.x - n.y * n.y) * mesh.sky_diffuse[8].rgb);
}

vec3 sky_seen(vec3 direction, float roughness) {
    return textureLod(sky, direction, roughness * (kSkyLevels - 1.0)).rgb;
}

// Share of the sky that a mirror of this roughness shows: Karis 2014's fit of Lazarov's.
vec3 mirrored_share(vec3 f0, float roughness, float cosine) {
    vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a = min(r.x * r.x, exp2(-9.28 * cosine)) * r.x + r.y;
    vec2 scale = vec2(-1.04, 1.04) * a + r.zw;
    return f0 * scale.x + scale.y;
}

// Lit share of a point: 3 x 3 texels, each weighed by how much of it the kernel covers.
float unshadowed(int light, vec3 point_m, vec3 normal) {
    int map = int(mesh.lights[light].shape.z);
    vec4 at = mesh.shadow_from_world[map] * vec4(point_m, 1.0);
    vec2 inside = abs(at.xy / max(at.w, 1e-4) - 0.5);
    map = max(inside.x, inside.y) < 0.48 ? map : int(mesh.lights[light].shape.w);
    vec2 texel = mesh.shadow_texels[map].xy;
    float width_m = texel.x + texel.y * distance(point_m, mesh.lights[light].place.xyz);
    at = mesh.shadow_from_world[map] * vec4(point_m + normal * (2.0 * width_m), 1.0);
    vec3 place = at.xyz / max(at.w, 1e-4);
    vec2 texels = place.xy / mesh.more.y - 0.5;
    vec2 first = floor(texels);
    vec2 f = texels - first;
    float nearer = place.z + mesh.shadow_texels[map].z;
    float lit = 0.0;
    vec2 corner = first * mesh.more.y;
    vec4 x_weights = vec4(1.0 - f.x, 1.0, 1.0, f.x);
    vec4 y_weights = vec4(1.0 - f.y, 1.0, 1.0, f.y);
    for (int j = 0; j < 2; ++j) {
        for (int i = 0; i < 2; ++i) {
            vec4 depths = textureGather(
                shadow_maps, vec3(corner + vec2(2 * i, 2 * j) * mesh.more.y, float(map)));
            vec4 open = vec4(lessThanEqual(depths, vec4(nearer)));
            lit += y_weights[2 * j] * (x_weights[2 * i] * open.w + x_weights[2 * i + 1] * open.z) +
                   y_weights[2 * j + 1] * (x_weights[2 * i] * open.x + x_weights[2 * i + 1] * open.y);
        }
    }
    vec2 out_of_map = abs(place.xy - 0.5);
    return max(out_of_map.x, out_of_map.y) < 0.5 && at.w > 0.0 ? lit * (1.0 / 9.0) : 1.0;
}

// One texel of the map, for what reflections show.
float roughly_unshadowed(int light, vec3 point_m, vec3 normal) {
    int map = int(mesh.lights[light].shape.w);
    vec4 at = mesh.shadow_from_world[map] *
              vec4(point_m + normal * (2.0 * mesh.shadow_texels[map].x), 1.0);
    vec3 place = at.xyz / max(at.w, 1e-4);
    float depth = textureLod(shadow_maps, vec3(place.xy, float(map)), 0.0).r;
    return depth <= place.z + mesh.shadow_texels[map].z ? 1.0 : 0.0;
}

// A surface as a sample sees it that stands for more than a pixel: its normal is the mean over the
// footprint, and its highlights are wider by how much normals differ there (Tokuyoshi and Kaplanyan
// 2019, of normals that are read instead of derived). What lies elsewhere in depth, or is of another
// kind, is another surface.
Surface over_footprint(Surface s, ivec2 texel, float depth, mat2 footprint_px) {
    vec3 sum = s.normal;
    float count = 1.0;
    float longest_px = max(dot(footprint_px[0], footprint_px[0]),
                           dot(footprint_px[1], footprint_px[1]));
    // A pixel's own are in the G-buffer already. What is no number is not larger either.
    int taps = s.kind != kKindUnlit && longest_px > 2.0 && longest_px < 1e5 ? 4 : 0;
    for (int i = 0; i < taps; ++i) {
        // Apart by as much as a Gaussian of the footprint's width spreads.
        vec2 aside = footprint_px * (0.4 * vec2(2 * (i & 1) - 1, (i & 2) - 1));
        ivec2 other = texel_at(vec2(texel) + 0.5 + aside);
        Surface there = unpacked_surface(texelFetch(g_buffer, other, 0));
        float there_depth = texelFetch(g_depth, other, 0).r;
        bool same = there.kind == s.kind && abs(there_depth - depth) < 0.1 * depth;
        sum += same ? there.normal : vec3(0.0);
        count += same ? 1.0 : 0.0;
    }
    vec3 mean = sum / count;
    float square = dot(mean, mean);
    float spread = clamp(1.0 - square, 0.0, 1.0);
    float alpha2 = s.roughness * s.roughness;
    alpha2 *= alpha2;
    s.roughness = sqrt(sqrt(min(alpha2 + 2.0 * spread, 1.0)));
    s.normal = square > 1e-4 ? mean * inversesqrt(square) : s.normal;
    return s;
}

struct Shading {
    vec3 point_m;
    vec3 normal;
    vec3 to_eye;
    vec3 diffuse;  // albedo / pi
    vec3 f0;
    float alpha;   // GGX
    float facing;  // cosine of normal and eye
};

// What a light of this irradiance per cosine sends to the eye: Lambert and GGX with Smith's
// masking (Heitz 2014) and Schlick's Fresnel.
vec3 sent_on(Shading s, vec3 to_light, vec3 light) {
    float cosine = clamp(dot(s.normal, to_light), 0.0, 1.0);
    vec3 halfway = to_light + s.to_eye;
    halfway *= inversesqrt(max(dot(halfway, halfway), 1e-8));
    float nh = clamp(dot(s.normal, halfway), 0.0, 1.0);
    float vh = clamp(dot(s.to_eye, halfway), 0.0, 1.0);
    float a2 = s.alpha * s.alpha;
    float bent = nh * nh * (a2 - 1.0) + 1.0;
    float lobe = a2 / max(kPi * bent * bent, 1e-9);
    float masked = cosine * sqrt(s.facing * s.facing * (1.0 - a2) + a2) +
                   s.facing * sqrt(cosine * cosine * (1.0 - a2) + a2);
    float away = 1.0 - vh;
    float away2 = away * away;
    vec3 fresnel = s.f0 + (1.0 - s.f0) * (away2 * away2 * away);
    vec3 mirrored = fresnel * (lobe * 0.5 / max(masked, 1e-5));
    return ((1.0 - fresnel) * s.diffuse + mirrored) * light * cosine;
}

// The way to a light, and what arrives from it.
vec3 arriving(int light, vec3 point_m, out vec3 to_light) {
    SceneLight at = mesh.lights[light];
    vec3 way = at.place.xyz - at.place.w * point_m;
    float square = max(dot(way, way), 1e-4);
    to_light = way * inversesqrt(square);
    float share = square * at.axis.w;
    float window = clamp(1.0 - share * share, 0.0, 1.0);
    float falloff = at.place.w > 0.0 ? window * window / square : 1.0;
    float cone = clamp(dot(-to_light, at.axis.xyz) * at.shape.x + at.shape.y, 0.0, 1.0);
    return at.color.rgb * (falloff * cone * cone);
}

// How open the half-space above a point is, by what the picture shows around it.
float openness(ivec2 texel, vec3 point_m, vec3 normal, float ahead_m, int taps) {
    const vec2 spiral[8] = vec2[8](vec2(0.30, 0.10), vec2(-0.15, 0.40), vec2(-0.50, -0.20),
                                   vec2(0.10, -0.55), vec2(0.65, -0.35), vec2(0.45, 0.65),
                                   vec2(-0.70, 0.50), vec2(-0.55, -0.80));
    const float reach_m = 0.45;
    float pixels_per_tangent = image_size().x / (eye.tangents.y - eye.tangents.x);
    float reach_px = clamp(reach_m * pixels_per_tangent / ahead_m, 3.0, 0.12 * image_size().x);
    float covered = 0.0;
    for (int i = 0; i < taps; ++i) {
        ivec2 other = texel_at(vec2(texel) + 0.5 + reach_px * spiral[i]);
        vec3 way = point_at(other, texelFetch(g_depth, other, 0).r) - point_m;
        float square = dot(way, way) + 1e-6;
        float above = max(dot(normal, way) * inversesqrt(square) - 0.12, 0.0);
        covered += above * max(0.0, 1.0 - square * (1.0 / (reach_m * reach_m)));
    }
    return clamp(1.0 - covered * (2.0 / max(float(kOcclusionTaps), 1.0)), 0.0, 1.0);
}

// What a texel shows, by the strongest shadowed light and the sky alone: for reflections.
vec3 roughly_lit(ivec2 texel, float depth) {
    Surface s = unpacked_surface(texelFetch(g_buffer, texel, 0));
    vec3 point_m = point_at(texel, depth);
    vec3 sum = sky_diffuse_at(s.normal) * s.occlusion;
    if (kShadowLights > 0) {
        vec3 to_light;
        vec3 light = arriving(0, point_m, to_light);
        sum += light * (max(dot(s.normal, to_light), 0.0) / kPi) *
               roughly_unshadowed(0, point_m, s.normal);
    }
    return s.emitted + (s.kind == kKindSurface ? s.base_color * sum : vec3(0.0));
}

// What is seen in a direction from a point: of the picture where that shows it, else of the sky.
// A null direction asks for nothing.
vec3 reflected(vec3 from_m, vec3 direction, float roughness, bool wanted) {
    vec3 sky_part = sky_seen(direction, roughness);
    if (kReflectionSteps == 0) {
        return sky_part;
    }
    const float longer = 1.28;
    int steps = wanted ? kReflectionSteps : 0;
    float reach_m = 0.06;
    float before_m = 0.0;
    float hit = 0.0;
    for (int i = 0; i < steps; ++i) {
        vec3 at = seen_at(from_m + reach_m * direction);
        vec2 inside = abs(at.xy / image_size() - 0.5);
        if (at.z < kNear_m || max(inside.x, inside.y) > 0.5) {
            break;
        }
        float depth = texelFetch(g_depth, texel_at(at.xy), 0).r;
        float shown_m = kNear_m / max(depth, 1e-7);
        if (at.z > shown_m && at.z - shown_m < 0.6 * (reach_m - before_m) + 0.25) {
            hit = 1.0;
            break;
        }
        before_m = reach_m;
        reach_m = reach_m * longer + 0.03;
    }
    int halvings = hit > 0.0 ? 5 : 0;
    for (int i = 0; i < halvings; ++i) {
        float middle_m = 0.5 * (before_m + reach_m);
        vec3 at = seen_at(from_m + middle_m * direction);
        float shown_m = kNear_m / max(texelFetch(g_depth, texel_at(at.xy), 0).r, 1e-7);
        if (at.z > shown_m) {
            reach_m = middle_m;
        } else {
            before_m = middle_m;
        }
    }
    vec3 shown = sky_part;
    for (int once = 0; once < int(hit); ++once) {
        vec3 at = seen_at(from_m + reach_m * direction);
        ivec2 texel = texel_at(at.xy);
        vec2 inside = abs(at.xy / image_size() - 0.5);
        // Fades towards the picture's border and towards rough mirrors.
        float weight = clamp((0.5 - max(inside.x, inside.y)) * 12.0, 0.0, 1.0) *
                       clamp((kGlossy - roughness) * (2.0 / kGlossy), 0.0, 1.0);
        shown = mix(sky_part, roughly_lit(texel, texelFetch(g_depth, texel, 0).r), weight);
    }
    return shown;
}

Shading shading_of(Surface s, vec3 point_m) {
    vec3 to_eye = normalize(eye.camera_and_time.xyz - point_m);
    float alpha = max(s.roughness * s.roughness, kLeastAlpha);
    return Shading(point_m, s.normal, to_eye, s.base_color * ((1.0 - s.metallic) / kPi),
                   mix(vec3(0.04), s.base_color, s.metallic), alpha,
                   clamp(dot(s.normal, to_eye), 1e-3, 1.0));
}

// What a surface sends to the eye by itself. What it lets through of what is behind it goes to
// `through`.
vec3 lit(Surface s, ivec2 texel, float depth, mat2 footprint_px, out vec3 through) {
    if (kFootprint && s.kind == kKindSurface) {
        s = over_footprint(s, texel, depth, footprint_px);
    }
    vec3 radiance = s.emitted;
    through = vec3(0.0);
    // Groups of pixels that show nothing but sky leave here: `if` would only mask them. The counts
    // are no constants, so that the loops stay loops: several copies of what is in them would be
    // more than lavapipe keeps compiled.
    int surfaces = s.kind != kKindUnlit ? 1 : 0;
    int shadow_lights = surfaces * kShadowLights;
    int all_lights = surfaces * (kShadowLights + kPlainLights);
    bool clear = s.kind >= kKindGlass;
    for (int once = 0; once < surfaces; ++once) {
        float ahead_m = kNear_m / max(depth, 1e-7);
        Shading at = shading_of(s, point_at(texel, depth));
        float own = clear ? 1.0 - s.transmission : 1.0;
        at.diffuse *= own;
        vec3 to_light;
        for (int i = 0; i < all_lights; ++i) {
            vec3 light = arriving(i, at.point_m, to_light);
            bool dark =
                dot(at.normal, to_light) <= 0.0 || max(light.r, max(light.g, light.b)) <= 0.0;
            int shadows = dark || i >= shadow_lights ? 0 : 1;
            float open = 1.0;
            for (int one = 0; one < shadows; ++one) {
                open = unshadowed(i, at.point_m, at.normal);
            }
            int lights = dark ? 0 : 1;
            for (int one = 0; one < lights; ++one) {
                radiance += sent_on(at, to_light, light) * open;
            }
        }
        float open = s.occlusion;
        if (kOcclusionTaps > 0) {
            open *= openness(texel, at.point_m, at.normal, ahead_m, clear ? 0 : kOcclusionTaps);
        }
        vec3 mirror = reflect(-at.to_eye, at.normal);
        vec3 share = mirrored_share(at.f0, s.roughness, at.facing);
        radiance += open * kPi * at.diffuse * (1.0 - at.f0) * sky_diffuse_at(at.normal);
        // Lagarde and de Rousiers 2014: what is occluded of a lobe.
        float glossy_open =
            clamp(pow(at.facing + open, exp2(-16.0 * s.roughness - 1.0)) - 1.0 + open, 0.0, 1.0);
        radiance += share * glossy_open *
                    reflected(at.point_m + 0.01 * at.normal, mirror, s.roughness,
                              s.roughness < kGlossy);
        vec3 tint = s.kind == kKindGlass ? s.base_color : vec3(1.0);
        through = clear ? (1.0 - share) * tint * s.transmission : through;
    }
    return radiance;
}

SceneSample scene_sample(SamplePlace place, float time_s) {
    ivec2 texel = texel_at(place.position_px);
    float nearest = texelFetch(g_depth, texel, 0).r;
    ivec2 behind = texel;
    int layers = 1;
    uvec4 front = uvec4(0u);
    if (kHasGlass) {
        front = texelFetch(glass_buffer, texel, 0);
        layers += (front.z >> 24) >= kKindGlass ? 1 : 0;
        for (int layer = 1; layer < layers; ++layer) {
            nearest = texelFetch(glass_depth, texel, 0).r;
            Surface s = unpacked_surface(front);
            vec3 front_m = point_at(texel, nearest);
            // Bent on its way in; where it comes out again, the picture shows what is behind.
            const float thickness_m = 0.3;
            vec3 on = refract(normalize(front_m - eye.camera_and_time.xyz), s.normal, 1.0 / 1.5);
            ivec2 bent = texel_at(seen_at(front_m + thickness_m * on).xy);
            behind = s.kind == kKindGlass ? bent : behind;
        }
    }
    // What is behind first, then what is in front of it.
    vec3 radiance = vec3(0.0);
    uvec4 shown = texelFetch(g_buffer, behind, 0);
    float depth = texelFetch(g_depth, behind, 0).r;
    ivec2 at = behind;
    for (int layer = 0; layer < layers; ++layer) {
        vec3 through;
        vec3 own = lit(unpacked_surface(shown), at, depth, place.footprint_px, through);
        radiance = through * radiance + own;
        shown = front;
        depth = nearest;
        at = texel;
    }
    vec3 way = ray_per_axis_m(vec2(texel) + 0.5);
    float nearness = nearest * inversesqrt(dot(way, way)) / kNear_m;
    vec3 point_m = point_at(texel, nearest);
    return SceneSample(max(radiance * mesh.more.x, vec3(0.0)), nearness,
                       motion_of_still_px(place.position_px, point_m));
}

#endif
