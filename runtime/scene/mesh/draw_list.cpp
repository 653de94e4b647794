#include "runtime/scene/mesh/draw_list.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>

namespace gazeloop::scene::mesh {

DrawList::DrawList(const MeshData& data) : levels_(data.levels) {
    things_.reserve(data.instances.size());
    for (const Instance& instance : data.instances) {
        const Primitive& finest = data.primitives[levels_[instance.first_level].primitive];
        const glm::mat4x3& frame = instance.world_from_local;
        const float scale =
            std::max({glm::length(frame[0]), glm::length(frame[1]), glm::length(frame[2])});
        const glm::vec3 middle = 0.5F * (finest.bounds.low_m + finest.bounds.high_m);
        things_.push_back(
            {.centre_m = frame * glm::vec4(middle, 1.0F),
             .radius_m = 0.5F * scale * glm::length(finest.bounds.high_m - finest.bounds.low_m),
             .scale = scale,
             .material = finest.material,
             .first_level = instance.first_level,
             .level_count = instance.level_count});
    }
    if (things_.empty()) {
        return;
    }
    glm::vec3 middle(0.0F);
    for (const Thing& thing : things_) {
        middle += thing.centre_m / static_cast<float>(things_.size());
    }
    std::vector<float> reaches;
    reaches.reserve(things_.size());
    for (const Thing& thing : things_) {
        reaches.push_back(glm::length(thing.centre_m - middle) + thing.radius_m);
    }
    // Nine things of ten: a ground or a far hill is no measure.
    const auto most = reaches.begin() + static_cast<std::ptrdiff_t>((reaches.size() - 1) * 9 / 10);
    std::ranges::nth_element(reaches, most);
    main_sphere_ = glm::vec4(middle, *most);
}

bool DrawList::may_be_seen(const Thing& thing, const Frustum& frustum) {
    return std::ranges::all_of(frustum.planes, [&](const glm::vec4& plane) {
        return glm::dot(glm::vec3(plane), thing.centre_m) + plane.w >= -thing.radius_m;
    });
}

Draw DrawList::drawn(const Thing& thing, std::uint32_t index, const Frustum& frustum) const {
    const float distance_m =
        std::max(glm::length(thing.centre_m - frustum.eye_m) - thing.radius_m, 0.0F);
    const float allowed_m = frustum.error_m + frustum.error_per_m * distance_m;
    std::uint32_t primitive = levels_[thing.first_level].primitive;
    for (std::uint32_t i = 0; i < thing.level_count; ++i) {
        const DetailLevel& level = levels_[thing.first_level + i];
        if (i > 0 && level.error_m * thing.scale > allowed_m) {
            break;
        }
        primitive = level.primitive;
    }
    return {primitive, index, distance_m};
}

void DrawList::sort(std::vector<Draw>& draws) {
    std::ranges::sort(draws, [](const Draw& a, const Draw& b) {
        return std::tie(a.distance_m, a.instance) < std::tie(b.distance_m, b.instance);
    });
}

}  // namespace gazeloop::scene::mesh
