#include "runtime/openxr_layer/placed_gaze.h"

#include <glm/geometric.hpp>

namespace gazeloop::openxr_layer {

Moving place_gaze(const Moving& head, const GazeInHead& gaze, const gaze::Pose& fixed) {
    const gaze::Pose in_base = gaze::compose(head.pose, gaze.pose);
    Moving placed{.pose = gaze::compose(in_base, fixed), .linear = {}, .angular = {}};
    if (!head.angular || !gaze.turning) {
        return placed;
    }
    // The head turns about its origin, the gaze about its own.
    const glm::dvec3 turning = head.pose.orientation * *gaze.turning;
    placed.angular = *head.angular + turning;
    if (head.linear) {
        placed.linear = *head.linear +
                        glm::cross(*head.angular, placed.pose.position_m - head.pose.position_m) +
                        glm::cross(turning, placed.pose.position_m - in_base.position_m);
    }
    return placed;
}

Moving inverse(const Moving& moving) {
    Moving other{.pose = gaze::inverse(moving.pose), .linear = {}, .angular = {}};
    const glm::dquat& back = other.pose.orientation;
    if (moving.angular) {
        other.angular = -(back * *moving.angular);
        if (moving.linear) {
            other.linear =
                -(back * (*moving.linear - glm::cross(*moving.angular, moving.pose.position_m)));
        }
    }
    return other;
}

}  // namespace gazeloop::openxr_layer
