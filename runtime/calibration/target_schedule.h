#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace gazeloop::calibration {

/// Which point is shown when: three by three, the middle one first, far ones never in a row. Points
/// move with the head.
struct TargetSchedule {
    double half_width_deg = 15.0;   ///< azimuth of the outer points
    double half_height_deg = 10.0;  ///< their elevation
    double shown_s = 1.6;           ///< each
    /// Of that the begin, in which the eye finds the point: a saccade's latency, its duration, and
    /// the time from the eye to here.
    double settling_s = 0.7;

    /// Unit vectors in the head, in the order in which they are shown.
    [[nodiscard]] std::vector<glm::dvec3> targets() const;
    /// Of all of them.
    [[nodiscard]] double length_s() const;

    struct Shown {
        std::size_t target = 0;
        bool settled = false;  ///< shown for longer than settling_s
    };
    /// At so many seconds from the start; none before it, and after the end.
    [[nodiscard]] std::optional<Shown> at(double seconds) const;
};

}  // namespace gazeloop::calibration
