#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "runtime/gaze/direction.h"
#include "runtime/gaze/eye.h"

namespace gazeloop::gaze {

/// Where both eyes look together: the middle of the directions of those that are seen. Where one
/// is lost or found, the direction goes on from where it was, so that no movement is seen that is
/// none.
class CyclopeanGaze {
  public:
    /// Unit vectors; none where an eye is not seen. None where no eye is, which begins anew.
    std::optional<glm::dvec3> add(const PerEye<std::optional<glm::dvec3>>& eyes) {
        glm::dvec3 sum{0.0};
        unsigned seen = 0;
        for (const Eye eye : kEyes) {
            if (const auto& direction = eyes[index(eye)]) {
                sum += *direction;
                seen |= 1U << index(eye);
            }
        }
        const auto middle = unit(sum);
        if (!middle) {
            seen_ = 0;
            return std::nullopt;
        }
        if (seen_ == 0) {
            offset_ = glm::dvec3{0.0};
        } else if (seen != seen_) {
            offset_ = last_ - *middle;
        }
        seen_ = seen;
        last_ = unit(*middle + offset_).value_or(*middle);
        return last_;
    }
    void turn(const glm::dquat& rotation) {
        last_ = rotation * last_;
        offset_ = rotation * offset_;
    }

  private:
    unsigned seen_ = 0;  ///< a bit for each eye
    glm::dvec3 last_{0.0};
    glm::dvec3 offset_{0.0};
};

}  // namespace gazeloop::gaze
