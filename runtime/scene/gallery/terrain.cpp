#include "runtime/scene/gallery/terrain.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/scene/gallery/seamless_noise.h"

namespace gazeloop::scene::gallery {
namespace {

constexpr double kEye_m = 1.4;  ///< of the origin above the ground
constexpr double kReach_m = 110.0;
constexpr std::uint32_t kTiles = 5;       ///< each way
constexpr std::uint32_t kTileCells = 20;  ///< each way: 2 * (5 * 20)^2 triangles
constexpr double kTexture_m = 3.0;        ///< that the texture spans

/// From [-1, 1] to metres, three times as fine in the middle.
double spread_m(double share) { return kReach_m * share * (0.3 + 0.7 * share * share); }

}  // namespace

double ground_m(double x_m, double z_m) {
    const double u = x_m / 160.0 + 0.5;
    const double v = z_m / 160.0 + 0.5;
    const double far = std::clamp((std::hypot(x_m, z_m + 12.0) - 28.0) / 50.0, 0.0, 1.0);
    const double hills = far * far * (3.0 - 2.0 * far);
    return -kEye_m + 0.5 * (seamless_octaves(u, v, 16, 2, 97) - 0.5) +
           15.0 * hills * seamless_octaves(u, v, 5, 4, 103);
}

void add_terrain(std::uint32_t material, mesh::MeshData& data) {
    constexpr std::uint32_t kCells = kTiles * kTileCells;
    const auto at = [](std::uint32_t step) { return spread_m(2.0 * step / double{kCells} - 1.0); };
    for (std::uint32_t tile = 0; tile < kTiles * kTiles; ++tile) {
        mesh::Primitive primitive;
        primitive.first_index = static_cast<std::uint32_t>(data.indices.size());
        primitive.first_vertex = static_cast<std::uint32_t>(data.vertices.size());
        primitive.material = material;
        const std::uint32_t row0 = tile / kTiles * kTileCells;
        const std::uint32_t column0 = tile % kTiles * kTileCells;
        for (std::uint32_t row = 0; row <= kTileCells; ++row) {
            for (std::uint32_t column = 0; column <= kTileCells; ++column) {
                const double x = at(column0 + column);
                const double z = at(row0 + row);
                constexpr double kStep_m = 0.25;
                const glm::dvec3 normal = glm::normalize(
                    glm::dvec3(ground_m(x - kStep_m, z) - ground_m(x + kStep_m, z), 2.0 * kStep_m,
                               ground_m(x, z - kStep_m) - ground_m(x, z + kStep_m)));
                const glm::dvec3 along(1.0, 0.0, 0.0);
                mesh::Vertex vertex;
                vertex.position_m = glm::vec3(glm::dvec3(x, ground_m(x, z), z));
                vertex.normal = glm::vec3(normal);
                vertex.tangent = glm::vec4(
                    glm::vec3(glm::normalize(along - glm::dot(along, normal) * normal)), 1.0F);
                vertex.uv[0] = glm::vec2(glm::dvec2(x, z) / kTexture_m);
                vertex.uv[1] = vertex.uv[0];
                primitive.bounds.low_m = glm::min(primitive.bounds.low_m, vertex.position_m);
                primitive.bounds.high_m = glm::max(primitive.bounds.high_m, vertex.position_m);
                data.vertices.push_back(vertex);
            }
        }
        for (std::uint32_t row = 0; row < kTileCells; ++row) {
            for (std::uint32_t column = 0; column < kTileCells; ++column) {
                const std::uint32_t a = row * (kTileCells + 1) + column;
                const std::uint32_t b = a + kTileCells + 1;
                data.indices.insert(data.indices.end(), {a, b, a + 1, a + 1, b, b + 1});
            }
        }
        primitive.index_count =
            static_cast<std::uint32_t>(data.indices.size()) - primitive.first_index;
        primitive.vertex_count =
            static_cast<std::uint32_t>(data.vertices.size()) - primitive.first_vertex;
        data.instances.push_back(
            {.first_level = static_cast<std::uint32_t>(data.levels.size()), .level_count = 1});
        data.levels.push_back({static_cast<std::uint32_t>(data.primitives.size()), 0.0F});
        data.primitives.push_back(primitive);
    }
}

}  // namespace gazeloop::scene::gallery
