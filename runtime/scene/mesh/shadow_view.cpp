#include "runtime/scene/mesh/shadow_view.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_float3x3.hpp>
#include <glm/geometric.hpp>

namespace gazeloop::scene::mesh {
namespace {

/// How far towards the light of a directional map's sphere things still cast shadows into it, m.
constexpr float kBefore_m = 60.0F;
constexpr float kSpotNear_m = 0.1F;
constexpr float kSpotFar_m = 60.0F;

struct Axes {
    glm::vec3 x, y, z;  ///< right, down, the way that the light goes
};

Axes axes_of(const glm::vec3& direction) {
    const glm::vec3 aside =
        std::abs(direction.y) < 0.95F ? glm::vec3(0.0F, 1.0F, 0.0F) : glm::vec3(1.0F, 0.0F, 0.0F);
    const glm::vec3 x = glm::normalize(glm::cross(direction, aside));
    return {x, glm::cross(direction, x), direction};
}

/// Rows into a matrix.
glm::mat4 from_rows(const glm::vec4& x, const glm::vec4& y, const glm::vec4& z,
                    const glm::vec4& w) {
    return glm::transpose(glm::mat4(x, y, z, w));
}

ShadowView directional(const glm::vec3& direction, const glm::vec4& sphere_m,
                       std::uint32_t texels) {
    const Axes axes = axes_of(direction);
    const glm::vec3 centre(sphere_m);
    const float radius = std::max(sphere_m.w, 0.01F);
    const float depth_m = 2.0F * radius + kBefore_m;
    const auto row = [&](const glm::vec3& axis, float scale) {
        return glm::vec4(axis * scale, -glm::dot(axis, centre) * scale);
    };
    glm::vec4 z = row(axes.z, -1.0F / depth_m);
    z.w += radius / depth_m;  // 0 at the sphere's far end
    ShadowView view;
    view.clip_from_world = from_rows(row(axes.x, 1.0F / radius), row(axes.y, 1.0F / radius), z,
                                     {0.0F, 0.0F, 0.0F, 1.0F});
    view.texel_m = 2.0F * radius / static_cast<float>(texels);
    const auto plane = [&](const glm::vec3& inwards, float reach) {
        return glm::vec4(inwards, reach - glm::dot(inwards, centre));
    };
    view.frustum.planes = {plane(axes.x, radius), plane(-axes.x, radius), plane(axes.y, radius),
                           plane(-axes.y, radius), plane(-axes.z, radius)};
    view.frustum.eye_m = centre;
    view.frustum.error_m = 0.5F * view.texel_m;
    return view;
}

ShadowView spot(const Light& light, std::uint32_t texels) {
    const Axes axes = axes_of(light.direction);
    const float reach = std::tan(std::min(light.outer_cone_rad, 1.5F));
    const float far_m = std::clamp(light.range_m, 2.0F * kSpotNear_m, kSpotFar_m);
    const auto row = [&](const glm::vec3& axis, float scale) {
        return glm::vec4(axis * scale, -glm::dot(axis, light.position_m) * scale);
    };
    // clip z = near * (far - d) / (far - near), so that z / d is 1 at the nearest and 0 farthest.
    const float slope = -kSpotNear_m / (far_m - kSpotNear_m);
    glm::vec4 z = row(axes.z, slope);
    z.w -= slope * far_m;
    ShadowView view;
    view.clip_from_world =
        from_rows(row(axes.x, 1.0F / reach), row(axes.y, 1.0F / reach), z, row(axes.z, 1.0F));
    view.texel_per_m = 2.0F * reach / static_cast<float>(texels);
    const float cosine = 1.0F / std::sqrt(1.0F + reach * reach);
    const auto side = [&](const glm::vec3& axis) {
        const glm::vec3 inwards = cosine * (reach * axes.z + axis);
        return glm::vec4(inwards, -glm::dot(inwards, light.position_m));
    };
    view.frustum.planes = {side(axes.x), side(-axes.x), side(axes.y), side(-axes.y),
                           glm::vec4(-axes.z, far_m + glm::dot(axes.z, light.position_m))};
    view.frustum.eye_m = light.position_m;
    view.frustum.error_per_m = 0.5F * view.texel_per_m;
    return view;
}

}  // namespace

std::vector<ShadowView> shadow_views(const Light& light, const glm::vec4& near_m,
                                     const glm::vec4& all_m, std::uint32_t texels) {
    if (light.kind == LightKind::Directional) {
        return {directional(light.direction, near_m, texels),
                directional(light.direction, all_m, texels)};
    }
    if (light.kind == LightKind::Spot) {
        return {spot(light, texels)};
    }
    return {};
}

}  // namespace gazeloop::scene::mesh
