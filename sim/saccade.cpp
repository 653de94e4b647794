#include "sim/saccade.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include "runtime/gaze/direction.h"
#include "sim/turned_direction.h"

namespace gazeloop::sim {

Saccade::Saccade(const glm::dvec3& resting) : from_(resting), to_(resting) {}

Saccade::Saccade(const glm::dvec3& from, const glm::dvec3& to, double vigour)
    : from_(from),
      to_(to),
      axis_(gaze::unit(glm::cross(from, to)).value_or(right_of(from))),
      amplitude_rad_(std::atan2(glm::length(glm::cross(from, to)), glm::dot(from, to))),
      course_(glm::degrees(amplitude_rad_), vigour) {}

glm::dvec3 Saccade::at(double elapsed_s) const {
    if (elapsed_s >= duration_s()) {
        return to_;
    }
    return glm::angleAxis(amplitude_rad_ * progress(elapsed_s), axis_) * from_;
}

}  // namespace gazeloop::sim
