#include "runtime/scene/mesh/check_mesh_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

namespace gazeloop::scene::mesh {
namespace {

constexpr float kUnitTolerance = 1e-3F;

/// Stops at the first thing that is wrong.
class Check {
  public:
    void that(bool holds, std::string_view what, std::size_t number, std::string_view why) {
        if (!holds && problem_.empty()) {
            problem_ = fmt::format("{} {} {}", what, number, why);
        }
    }
    [[nodiscard]] bool failed() const { return !problem_.empty(); }
    [[nodiscard]] const std::string& problem() const { return problem_; }

  private:
    std::string problem_;
};

template <typename Vector>
bool finite(const Vector& v) {
    for (int i = 0; i < Vector::length(); ++i) {
        if (!std::isfinite(v[i])) {
            return false;
        }
    }
    return true;
}

bool finite(const glm::mat4x3& m) {
    return finite(m[0]) && finite(m[1]) && finite(m[2]) && finite(m[3]);
}

bool unit(const glm::vec3& v) {
    return finite(v) && std::abs(v.x * v.x + v.y * v.y + v.z * v.z - 1.0F) < kUnitTolerance;
}

bool within(float value, float low, float high) { return value >= low && value <= high; }

/// Whether [first, first + count) lies in a list of `size`.
bool fits(std::size_t first, std::size_t count, std::size_t size) {
    return first <= size && count <= size - first;
}

void check_vertices(const MeshData& data, Check& check) {
    for (std::size_t i = 0; i < data.vertices.size() && !check.failed(); ++i) {
        const Vertex& vertex = data.vertices[i];
        check.that(finite(vertex.position_m), "vertex", i, "is at no finite place");
        check.that(unit(vertex.normal), "vertex", i, "has a normal that is not unit");
        check.that(unit(glm::vec3(vertex.tangent)) && std::abs(vertex.tangent.w) == 1.0F, "vertex",
                   i, "has a tangent that is not unit, or whose w is not 1 or -1");
        check.that(finite(vertex.uv[0]) && finite(vertex.uv[1]), "vertex", i,
                   "has texture coordinates that are not finite");
    }
}

void check_primitives(const MeshData& data, Check& check) {
    for (std::size_t i = 0; i < data.primitives.size() && !check.failed(); ++i) {
        const Primitive& at = data.primitives[i];
        check.that(at.index_count % 3 == 0, "primitive", i, "has a part of a triangle");
        check.that(fits(at.first_index, at.index_count, data.indices.size()), "primitive", i,
                   "has indices that are not there");
        check.that(fits(at.first_vertex, at.vertex_count, data.vertices.size()), "primitive", i,
                   "has vertices that are not there");
        check.that(at.material < data.materials.size(), "primitive", i,
                   "has a material that is not there");
        check.that(at.index_count == 0 || (finite(at.bounds.low_m) && finite(at.bounds.high_m)),
                   "primitive", i, "has no finite bounds");
        if (check.failed()) {
            return;
        }
        const auto first = data.indices.begin() + at.first_index;
        check.that(std::all_of(first, first + at.index_count,
                               [&](std::uint32_t index) { return index < at.vertex_count; }),
                   "primitive", i, "has an index beyond its vertices");
    }
}

void check_instances(const MeshData& data, Check& check) {
    for (std::size_t i = 0; i < data.levels.size(); ++i) {
        check.that(data.levels[i].primitive < data.primitives.size(), "detail level", i,
                   "has a primitive that is not there");
        check.that(data.levels[i].error_m >= 0.0F, "detail level", i, "has a negative error");
    }
    for (std::size_t i = 0; i < data.instances.size(); ++i) {
        const Instance& at = data.instances[i];
        check.that(at.level_count > 0 && fits(at.first_level, at.level_count, data.levels.size()),
                   "instance", i, "has detail levels that are not there");
        check.that(finite(at.world_from_local), "instance", i, "is at no finite place");
    }
}

void check_materials(const MeshData& data, Check& check) {
    for (std::size_t i = 0; i < data.materials.size(); ++i) {
        const Material& at = data.materials[i];
        for (const TextureUse* use :
             {&at.base_color_texture, &at.metallic_roughness_texture, &at.normal_texture,
              &at.occlusion_texture, &at.emissive_texture}) {
            check.that(use->image == kNone || use->image < data.images.size(), "material", i,
                       "has an image that is not there");
            check.that(use->uv_set < 2, "material", i, "has a set of texture coordinates above 1");
            check.that(
                finite(use->transform[0]) && finite(use->transform[1]) && finite(use->transform[2]),
                "material", i, "has a texture transform that is not finite");
        }
        check.that(finite(at.base_color) && finite(at.emissive) && std::isfinite(at.normal_scale),
                   "material", i, "has a colour or scale that is not finite");
        check.that(within(at.metallic, 0.0F, 1.0F) && within(at.roughness, 0.0F, 1.0F) &&
                       within(at.occlusion_strength, 0.0F, 1.0F) &&
                       within(at.transmission, 0.0F, 1.0F) && at.alpha_cutoff >= 0.0F &&
                       at.index_of_refraction >= 1.0F,
                   "material", i, "has a factor out of its range");
    }
}

void check_images(const MeshData& data, Check& check) {
    for (std::size_t i = 0; i < data.images.size(); ++i) {
        const Image& at = data.images[i];
        const std::size_t texel_bytes = at.format == TexelFormat::Rgba8 ? 4 : 8;
        check.that(at.width > 0 && at.height > 0, "image", i, "has no texels");
        check.that(at.texels.size() == texel_bytes * at.width * at.height, "image", i,
                   "has not the bytes that its size asks for");
    }
}

void check_lights(const MeshData& data, Check& check) {
    for (std::size_t i = 0; i < data.lights.size(); ++i) {
        const Light& at = data.lights[i];
        check.that(finite(at.color) && std::isfinite(at.intensity) && at.intensity >= 0.0F, "light",
                   i, "has no finite intensity");
        check.that(finite(at.position_m) && unit(at.direction), "light", i,
                   "has no finite place or no unit direction");
        check.that(at.range_m > 0.0F, "light", i, "reaches nowhere");
        check.that(at.kind != LightKind::Spot ||
                       (at.inner_cone_rad >= 0.0F && at.inner_cone_rad < at.outer_cone_rad &&
                        at.outer_cone_rad <= std::numbers::pi_v<float> / 2.0F),
                   "light", i, "has no cone");
    }
}

}  // namespace

Expected<void> check_mesh_data(const MeshData& data) {
    Check check;
    check_vertices(data, check);
    check_primitives(data, check);
    check_instances(data, check);
    check_materials(data, check);
    check_images(data, check);
    check_lights(data, check);
    check.that(std::isfinite(data.exposure) && data.exposure > 0.0F, "exposure", 0,
               "is not above 0");
    if (check.failed()) {
        return std::unexpected(
            Error{ErrorKind::BadInput, fmt::format("the scene is broken: {}", check.problem())});
    }
    return {};
}

}  // namespace gazeloop::scene::mesh
