#include "runtime/scene/gallery/gallery_scene.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "runtime/scene/gallery/gallery_materials.h"
#include "runtime/scene/gallery/parametric_surface.h"
#include "runtime/scene/gallery/terrain.h"
#include "runtime/scene/mesh/place_hash.h"

namespace gazeloop::scene::gallery {
namespace {

constexpr double kSpacing_m = 1.7;
/// Of the row that is farthest behind the viewer.
constexpr double kLastRow_m = 2.5;
/// Each form has half as many triangles as the one before.
constexpr std::uint32_t kForms = 8;

/// Levels of detail of one surface in one material, appended to the scene.
struct Shape {
    std::uint32_t first_level = 0;
};

/// The forms of a surface, as ranges of the scene's vertices and indices.
std::vector<std::pair<mesh::Primitive, float>> add_forms(const ParametricSurface& surface,
                                                         mesh::MeshData& data) {
    std::vector<std::pair<mesh::Primitive, float>> forms;
    for (std::uint32_t form = 0; form < kForms; ++form) {
        const Tessellation made = tessellate(surface, kFinestTriangles >> form);
        mesh::Primitive primitive;
        primitive.first_index = static_cast<std::uint32_t>(data.indices.size());
        primitive.index_count = static_cast<std::uint32_t>(made.indices.size());
        primitive.first_vertex = static_cast<std::uint32_t>(data.vertices.size());
        primitive.vertex_count = static_cast<std::uint32_t>(made.vertices.size());
        primitive.bounds = made.bounds;
        data.vertices.insert(data.vertices.end(), made.vertices.begin(), made.vertices.end());
        data.indices.insert(data.indices.end(), made.indices.begin(), made.indices.end());
        forms.emplace_back(primitive, made.error_m);
    }
    return forms;
}

glm::mat4x3 placed(const glm::dvec3& at_m, double size_m, double turn_rad, double tilt_rad) {
    const glm::dmat3 axes =
        size_m * glm::mat3_cast(glm::angleAxis(turn_rad, glm::dvec3(0.0, 1.0, 0.0)) *
                                glm::angleAxis(tilt_rad, glm::dvec3(1.0, 0.0, 0.0)));
    return {glm::vec3(axes[0]), glm::vec3(axes[1]), glm::vec3(axes[2]), glm::vec3(at_m)};
}

void add_objects(mesh::MeshData& data) {
    const auto surfaces = parametric_surfaces();
    const std::size_t materials = object_materials();
    std::vector<Shape> shapes;
    for (const ParametricSurface& surface : surfaces) {
        const auto forms = add_forms(surface, data);
        for (std::size_t material = 0; material < materials; ++material) {
            shapes.push_back({static_cast<std::uint32_t>(data.levels.size())});
            for (const auto& [form, error_m] : forms) {
                data.levels.push_back(
                    {static_cast<std::uint32_t>(data.primitives.size()), error_m});
                data.primitives.push_back(form);
                data.primitives.back().material = static_cast<std::uint32_t>(material);
            }
        }
    }
    for (std::uint32_t row = 0; row < kObjectsInRow; ++row) {
        for (std::uint32_t column = 0; column < kObjectsInRow; ++column) {
            const auto chance = [&](std::uint32_t what) {
                return mesh::hashed(static_cast<std::int32_t>(column),
                                    static_cast<std::int32_t>(row), 101 + what);
            };
            const auto pick = [&](std::uint32_t what, std::size_t of) {
                return std::min(static_cast<std::size_t>(chance(what) * static_cast<double>(of)),
                                of - 1);
            };
            const double size_m = 0.34 + 0.14 * chance(2);
            const double x_m = (column - 0.5 * (kObjectsInRow - 1)) * kSpacing_m;
            const double z_m = kLastRow_m - row * kSpacing_m;
            const double y_m = ground_m(x_m, z_m) + size_m + 0.05 + 0.75 * chance(3);
            const std::size_t shape = pick(0, surfaces.size()) * materials + pick(1, materials);
            data.instances.push_back({.first_level = shapes[shape].first_level,
                                      .level_count = kForms,
                                      .world_from_local = placed({x_m, y_m, z_m}, size_m,
                                                                 2.0 * std::numbers::pi * chance(4),
                                                                 0.7 * (chance(5) - 0.5))});
        }
    }
}

mesh::Light sun() {
    mesh::Light light;
    light.kind = mesh::LightKind::Directional;
    light.color = {1.0F, 0.93F, 0.82F};
    light.intensity = 3.6F;
    light.direction = glm::normalize(glm::vec3(-0.55F, -0.72F, -0.42F));
    return light;
}

mesh::Light spot(const glm::vec3& at_m, const glm::vec3& towards_m, const glm::vec3& color,
                 float intensity_cd) {
    mesh::Light light;
    light.kind = mesh::LightKind::Spot;
    light.color = color;
    light.intensity = intensity_cd;
    light.position_m = at_m;
    light.direction = glm::normalize(towards_m - at_m);
    light.range_m = 16.0F;
    light.inner_cone_rad = 0.35F;
    light.outer_cone_rad = 0.6F;
    return light;
}

mesh::Light lamp(const glm::vec3& at_m, const glm::vec3& color, float intensity_cd) {
    mesh::Light light;
    light.kind = mesh::LightKind::Point;
    light.color = color;
    light.intensity = intensity_cd;
    light.position_m = at_m;
    light.range_m = 6.0F;
    light.casts_shadow = false;
    return light;
}

void add_lights(mesh::MeshData& data) {
    data.lights = {sun(),
                   spot({-5.0F, 4.0F, -3.0F}, {-2.0F, -1.0F, -6.0F}, {1.0F, 0.62F, 0.30F}, 46.0F),
                   spot({5.5F, 4.5F, -7.0F}, {2.5F, -1.0F, -8.5F}, {0.35F, 0.60F, 1.0F}, 56.0F),
                   lamp({-1.7F, 0.3F, -4.2F}, {1.0F, 0.45F, 0.2F}, 2.2F),
                   lamp({1.8F, 0.2F, -3.3F}, {0.3F, 0.9F, 0.5F}, 1.4F),
                   lamp({0.0F, 0.6F, -9.0F}, {0.9F, 0.3F, 0.8F}, 3.0F),
                   lamp({-6.5F, 0.4F, -9.5F}, {0.3F, 0.5F, 1.0F}, 3.0F),
                   lamp({6.0F, 0.5F, -13.0F}, {1.0F, 0.8F, 0.4F}, 3.5F)};
}

}  // namespace

mesh::MeshData gallery_scene() {
    mesh::MeshData data;
    add_materials(data);
    add_objects(data);
    add_terrain(ground_material(), data);
    add_lights(data);
    data.sky = {.zenith = {0.16F, 0.32F, 0.68F},
                .horizon = {0.72F, 0.80F, 0.90F},
                .ground = {0.20F, 0.18F, 0.15F},
                .clouds = 0.45F};
    return data;
}

}  // namespace gazeloop::scene::gallery
