#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/gaze_source.h"
#include "runtime/error.h"

namespace gazeloop::drivers {

/// A direction in the head frame that does not move.
struct FixedGaze {
    double azimuth_deg = 0.0;    ///< positive to the right, -180 .. 180
    double elevation_deg = 0.0;  ///< positive up, -90 .. 90

    [[nodiscard]] glm::dvec3 direction() const;  ///< unit vector
};

/// "AZ,EL" in degrees, e.g. "-5,2.5". Errors (Usage): not two numbers, or out of range.
[[nodiscard]] Expected<FixedGaze> parse_fixed_gaze(std::string_view text);

/// Eyes that never move, for fixed foveation. Both are parallel (they look at infinity). Every poll
/// gives one sample, taken and arrived at the time of the poll, Modelled.
class FixedSource final : public GazeSource {
  public:
    /// Precondition: both angles in range.
    explicit FixedSource(const FixedGaze& fixed_gaze);

    void poll(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples) override;
    [[nodiscard]] bool fixed_in_head() const override { return true; }
    [[nodiscard]] std::string description() const override;

  private:
    FixedGaze gaze_;
    glm::dvec3 direction_;
    std::uint64_t sequence_ = 0;
};

}  // namespace gazeloop::drivers
