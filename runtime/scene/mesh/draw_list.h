#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "runtime/scene/mesh/mesh_data.h"

namespace gazeloop::scene::mesh {

/// What a picture shows of the world: everything on the inner side of all planes.
struct Frustum {
    std::array<glm::vec4, 5> planes{};  ///< unit normal inwards, distance; world
    glm::vec3 eye_m{0.0F};
    /// How far a form may lie from the finest one, m; and how much farther per m of distance.
    float error_m = 0.0F;
    float error_per_m = 0.0F;
};

struct Draw {
    std::uint32_t primitive = 0;
    std::uint32_t instance = 0;
    float distance_m = 0.0F;  ///< of its nearest point, roughly
};

/// Chooses what to draw: things that may be seen, each in the coarsest form that is exact
/// enough, the nearest first. Reuses the list's memory.
class DrawList {
  public:
    DrawList() = default;
    /// Of this scene's instances: only their places and sizes are kept.
    explicit DrawList(const MeshData& data);

    /// All draws of which `wanted(material)` is true.
    template <typename Wanted>
    void choose(const Frustum& frustum, const Wanted& wanted, std::vector<Draw>& draws) const {
        draws.clear();
        for (std::uint32_t i = 0; i < things_.size(); ++i) {
            const Thing& thing = things_[i];
            if (wanted(thing.material) && may_be_seen(thing, frustum)) {
                draws.push_back(drawn(thing, i, frustum));
            }
        }
        sort(draws);
    }

    /// The sphere around what is not out of scale: where shadows are worth their texels.
    [[nodiscard]] glm::vec4 main_sphere() const { return main_sphere_; }

  private:
    struct Thing {
        glm::vec3 centre_m;
        float radius_m;
        float scale;  ///< longest axis of its frame
        std::uint32_t material;
        std::uint32_t first_level;
        std::uint32_t level_count;
    };
    static bool may_be_seen(const Thing& thing, const Frustum& frustum);
    [[nodiscard]] Draw drawn(const Thing& thing, std::uint32_t index, const Frustum& frustum) const;
    static void sort(std::vector<Draw>& draws);

    std::vector<DetailLevel> levels_;
    std::vector<Thing> things_;
    glm::vec4 main_sphere_{0.0F};
};

}  // namespace gazeloop::scene::mesh
