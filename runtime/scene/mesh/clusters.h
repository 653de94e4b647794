#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "runtime/scene/mesh/mesh_data.h"

namespace gazeloop::scene::mesh {

/// Neighbouring triangles that can be left out together where all of them turn their backs: the
/// rasteriser's work on a vertex is one thread's in software, and half of a closed surface is
/// never seen.
class Clusters {
  public:
    /// Triangles of a cluster, as they follow each other in the indices.
    static constexpr std::uint32_t kTriangles = 128;

    Clusters() = default;
    explicit Clusters(const MeshData& data);

    /// Writes the indices of a primitive without the clusters that show an eye at this place only
    /// their backs; eye in the primitive's frame. Returns how many; none if they do not fit.
    [[nodiscard]] std::optional<std::uint32_t> facing(std::uint32_t primitive,
                                                      const glm::vec3& eye_m,
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
    static Cluster around(const MeshData& data, const Primitive& primitive,
                          std::span<const std::uint32_t> indices);

    std::vector<std::uint32_t> indices_;
    std::vector<Cluster> clusters_;
    std::vector<Range> ranges_;  ///< by primitive; those of the same triangles share clusters
};

}  // namespace gazeloop::scene::mesh
