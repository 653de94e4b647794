#include "runtime/render/cut.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace gazeloop::render {

bool is_cut(const CutPlace& before, const CutPlace& now) {
    const double half_turn_cosine =
        std::abs(glm::dot(before.pose.orientation, now.pose.orientation));
    return !(glm::distance(before.pose.position_m, now.pose.position_m) <= kCutStep_m &&
             half_turn_cosine >= std::cos(0.5 * kCutTurn_rad) &&
             std::abs(now.scene_time_s - before.scene_time_s) <= kCutTime_s);
}

}  // namespace gazeloop::render
