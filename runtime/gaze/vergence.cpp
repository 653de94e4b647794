#include "runtime/gaze/vergence.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/time/span.h"

namespace gazeloop::gaze {

double Vergence::follow(std::optional<double> found, double assumed, const glm::dvec3& direction,
                        std::int64_t now_ns) {
    const double wanted = found.value_or(assumed);
    const std::int64_t since_ns =
        last_ ? time::saturated(static_cast<__int128>(now_ns) - last_->now_ns) : 0;
    const bool same_fixation = last_ && since_ns >= 0 && since_ns <= kGap_ns &&
                               glm::dot(direction, last_->direction) >= std::cos(kJump_rad);
    if (!same_fixation || !last_->found) {
        last_ = {direction, now_ns, wanted, found.has_value()};
    } else {
        const double way = -std::expm1(static_cast<double>(-since_ns) * 1e-9 / kTimeConstant_s);
        last_ = {direction, now_ns, std::lerp(last_->nearness, wanted, way), true};
    }
    return last_->nearness;
}

}  // namespace gazeloop::gaze
