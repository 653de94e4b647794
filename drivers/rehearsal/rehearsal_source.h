#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/gaze_source.h"
#include "runtime/calibration/target_schedule.h"
#include "sim/arriving_samples.h"

namespace gazeloop::drivers {

/// A simulated person who looks at the points of a calibration as they are shown, with a simulated
/// tracker: so that a calibration can be tried from end to end. The eye begins to move a fifth of a
/// second after a point appears, and jumps.
class RehearsalSource final : public GazeSource {
  public:
    /// The schedule and the first sample begin at `start_ns` (host time). While `bad_point` (of the
    /// schedule) is shown, the person looks 8 degrees beside it.
    RehearsalSource(const calibration::TargetSchedule& schedule,
                    const sim::GazeSimulation& simulation, std::optional<std::size_t> bad_point,
                    std::int64_t start_ns);

    void poll(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples) override;
    [[nodiscard]] bool finished() const override { return arriving_.finished(); }
    [[nodiscard]] std::string description() const override;

    /// Where both eyes truly look so many seconds after the start: a unit vector in the head.
    [[nodiscard]] glm::dvec3 looks_at(double seconds) const;

  private:
    calibration::TargetSchedule schedule_;
    std::vector<glm::dvec3> targets_;
    std::optional<std::size_t> bad_point_;
    sim::ArrivingSamples arriving_;
};

}  // namespace gazeloop::drivers
