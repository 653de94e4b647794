#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace gazeloop::calibration {

/// Where an eye rested while a point was shown, by the samples of that time. Of them only those in
/// the fixation count: a saccade that came late, a glance aside and a glitch lie away from where
/// most are.
class SteadyGaze {
  public:
    /// A unit vector in the head that the tracker vouches for.
    void add(const glm::dvec3& direction) { directions_.push_back(direction); }
    void clear() { directions_.clear(); }
    [[nodiscard]] std::size_t samples() const { return directions_.size(); }

    /// So many samples are needed, of which at least this share within kNear times their spread.
    static constexpr std::size_t kFewest = 10;
    static constexpr double kSteadyShare = 0.5;
    /// Greatest SD of a fixation that counts as one: several times a headset tracker's noise.
    static constexpr double kGreatestSd_deg = 1.5;

    /// A unit vector; none where gaze was not steady.
    [[nodiscard]] std::optional<glm::dvec3> rest() const;

  private:
    std::vector<glm::dvec3> directions_;
};

}  // namespace gazeloop::calibration
