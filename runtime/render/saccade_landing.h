#pragma once

#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <optional>

#include "runtime/gaze/fovea_point.h"

namespace gazeloop::render {

/// Tells in which frame an eye lands after a saccade, for what forgets its past there. By the event
/// of the gaze where the run tells events. Else by the fovea: it is in a saccade while it moves by
/// more than kFast_rad a frame both in the head and in world (a head that turns, and eyes that turn
/// against it, move only one of them), and lands when it moves by less than kSlow_rad. Depends on
/// views and foveae alone, so that a replay does the same.
class SaccadeLanding {
  public:
    static constexpr double kFast_rad = 0.035;  ///< 2 degrees: 180 deg/s at 90 Hz
    static constexpr double kSlow_rad = 0.009;  ///< half a degree

    void reset() { *this = {}; }

    /// Takes the next frame. Returns whether a saccade landed in it.
    bool landed(const gaze::FoveaPoint& fovea, const gaze::Pose& eye) {
        const std::array<glm::dvec3, 2> now{fovea.direction, eye.orientation * fovea.direction};
        const bool was_flying = flying_;
        if (fovea.event) {
            flying_ = *fovea.event == gaze::EyeEvent::Saccade;
        } else if (last_) {
            const double moved_rad =
                std::min(angle_rad((*last_)[0], now[0]), angle_rad((*last_)[1], now[1]));
            flying_ = moved_rad > (flying_ ? kSlow_rad : kFast_rad);
        }
        last_ = now;
        return was_flying && !flying_;
    }

  private:
    static double angle_rad(const glm::dvec3& a, const glm::dvec3& b) {
        return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
    }

    std::optional<std::array<glm::dvec3, 2>> last_;
    bool flying_ = false;
};

}  // namespace gazeloop::render
