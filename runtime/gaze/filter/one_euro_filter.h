#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace gazeloop::gaze {

/// The One-Euro filter (Casiez, Roussel and Vogel 2012, CHI) on directions: a low-pass whose
/// cut-off rises with the speed. It calms a resting gaze, and lags behind a moving one.
class OneEuroFilter {
  public:
    struct Parameters {
        double least_cutoff_hz = 3.0;          ///< of a resting gaze; > 0
        double cutoff_hz_per_deg_per_s = 0.1;  ///< 0 or more
    };

    explicit OneEuroFilter(const Parameters& parameters) : parameters_(parameters) {}

    /// The next direction, a unit vector, filtered; a unit vector. One whose time is not after that
    /// of the one before begins anew.
    glm::dvec3 add(std::int64_t time_ns, const glm::dvec3& direction);
    /// What comes next does not follow on what was.
    void reset() { last_ns_.reset(); }
    void turn(const glm::dquat& rotation);

    /// How old the filtered direction is on average, beyond the newest sample's age: the mean age
    /// of the samples that are in it, by their weights. 0 as it begins.
    [[nodiscard]] double delay_s() const { return delay_s_; }

  private:
    Parameters parameters_;
    std::optional<std::int64_t> last_ns_;
    glm::dvec3 raw_{0.0};
    glm::dvec3 filtered_{0.0};
    glm::dvec3 velocity_{0.0};  ///< filtered, rad/s
    double delay_s_ = 0.0;
};

}  // namespace gazeloop::gaze
