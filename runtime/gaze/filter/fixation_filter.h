#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "runtime/gaze/events/eye_event.h"

namespace gazeloop::gaze {

/// A filter that works in fixations alone, where averaging costs nothing but drift: the mean of a
/// fixation's directions so far, and of about the last `memory_s` once it lasts longer. Everything
/// else passes as it is, without delay.
class FixationFilter {
  public:
    struct Parameters {
        double memory_s = 0.025;   ///< > 0
        double departs_deg = 0.3;  ///< further from the mean than this, a fixation begins anew
    };

    explicit FixationFilter(const Parameters& parameters) : parameters_(parameters) {}

    /// The next direction, a unit vector, filtered, by what the eyes do at it; a unit vector.
    glm::dvec3 add(std::int64_t time_ns, const glm::dvec3& direction, EyeEvent event);
    /// What comes next does not follow on what was.
    void reset() { last_ns_.reset(); }
    void turn(const glm::dquat& rotation) { mean_ = rotation * mean_; }

    /// As OneEuroFilter::delay_s.
    [[nodiscard]] double delay_s() const { return delay_s_; }

  private:
    Parameters parameters_;
    std::optional<std::int64_t> last_ns_;  ///< of the fixation that goes on
    std::uint64_t count_ = 0;
    glm::dvec3 mean_{0.0};
    double delay_s_ = 0.0;
};

}  // namespace gazeloop::gaze
