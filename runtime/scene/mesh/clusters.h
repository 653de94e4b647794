#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <vector>

#include "runtime/scene/mesh/draw_list.h"
#include "runtime/scene/mesh/mesh_data.h"

namespace gazeloop::scene::mesh {

/// Neighbouring triangles that can be left out together where all of them turn their backs or lie
/// beside the picture: the rasteriser's work on a vertex is one thread's in software, and half of a
/// closed surface is never seen.
class Clusters {
  public:
    /// Triangles of a cluster, as they follow each other in the indices. More of them leave more
    /// triangles in that nobody sees, fewer make the choice dearer than what it saves.
    static constexpr std::uint32_t kTriangles = 32;

    /// What a picture shows of the world, in a primitive's own frame.
    struct View {
        glm::vec3 eye_m{0.0F};
        /// Inwards, of any length (w along with it): of no length, a plane has everything.
        std::array<glm::vec4, 5> planes{};
    };
    /// Of a primitive that lies in the world by this frame, which has an inverse.
    [[nodiscard]] static View view_of(const Frustum& frustum, const glm::mat4x3& world_from_local);

    Clusters() = default;
    explicit Clusters(const MeshData& data);

    /// Writes the indices of a primitive without the clusters that a view does not show: beside its
    /// picture, or only backs. Returns how many; none if they do not fit.
    [[nodiscard]] std::optional<std::uint32_t> facing(std::uint32_t primitive, const View& view,
                                                      std::span<std::uint32_t> out) const;

  private:
    /// All normals lie within an angle of `axis`; its sine, or above 1 where that is no use.
    struct Cluster {
        glm::vec3 centre_m;
        float radius_m;
        glm::vec3 axis;
        float sine;
    };
    struct Range {
        std::uint32_t first_index;
        std::uint32_t index_count;
        std::uint32_t first_cluster;
    };
    static bool is_shown(const Cluster& cluster, const View& view);
    static Cluster around(const MeshData& data, const Primitive& primitive,
                          std::span<const std::uint32_t> indices);

    std::vector<std::uint32_t> indices_;
    std::vector<Cluster> clusters_;
    std::vector<Range> ranges_;  ///< by primitive; those of the same triangles share clusters
};

}  // namespace gazeloop::scene::mesh
