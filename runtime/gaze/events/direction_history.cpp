#include "runtime/gaze/events/direction_history.h"

#include <algorithm>
#include <glm/trigonometric.hpp>

namespace gazeloop::gaze {

void DirectionHistory::add(std::int64_t time_ns, const glm::dvec3& direction) {
    ring_[place_ % kMost] = {time_ns, direction};
    ++place_;
    held_ = std::min(held_ + 1, kMost);
}

void DirectionHistory::turn(const glm::dquat& rotation) {
    for (Point& point : ring_) {
        point.direction = rotation * point.direction;
    }
}

std::size_t DirectionHistory::oldest_within(std::size_t from, std::int64_t span_ns) const {
    const std::int64_t end_ns = back(from).time_ns;
    std::size_t within = from;
    std::size_t beyond = held_;
    while (beyond - within > 1) {
        const std::size_t middle = within + (beyond - within) / 2;
        (end_ns - back(middle).time_ns <= span_ns ? within : beyond) = middle;
    }
    return within;
}

double DirectionHistory::elapsed_s(std::size_t older, std::size_t newer) const {
    return static_cast<double>(back(newer).time_ns - back(older).time_ns) * 1e-9;
}

glm::dvec3 DirectionHistory::velocity_deg_per_s(std::size_t oldest) const {
    double mean_s = 0.0;
    for (std::size_t i = 0; i <= oldest; ++i) {
        mean_s += elapsed_s(i, 0);
    }
    mean_s /= static_cast<double>(oldest + 1);
    glm::dvec3 with_time{0.0};
    double squares = 0.0;
    for (std::size_t i = 0; i <= oldest; ++i) {
        const double later_s = mean_s - elapsed_s(i, 0);
        with_time += later_s * back(i).direction;
        squares += later_s * later_s;
    }
    return glm::degrees(with_time / squares);
}

}  // namespace gazeloop::gaze
