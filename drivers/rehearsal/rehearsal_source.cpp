#include "drivers/rehearsal/rehearsal_source.h"

#include <glm/trigonometric.hpp>

#include "runtime/calibration/eye_calibration.h"

namespace gazeloop::drivers {

RehearsalSource::RehearsalSource(const calibration::TargetSchedule& schedule,
                                 const sim::GazeSimulation& simulation,
                                 std::optional<std::size_t> bad_point, std::int64_t start_ns)
    : schedule_(schedule),
      targets_(schedule.targets()),
      bad_point_(bad_point),
      arriving_(sim::EyeTracker(simulation.tracker, simulation.seed, start_ns)) {}

glm::dvec3 RehearsalSource::looks_at(double seconds) const {
    constexpr double kReaction_s = 0.2;
    constexpr double kBeside_deg = 8.0;
    const auto shown = schedule_.at(seconds - kReaction_s);
    if (!shown) {
        return targets_.front();
    }
    glm::dvec3 direction = targets_[shown->target];
    if (shown->target == bad_point_) {
        calibration::GazeAngles angles = calibration::angles_of(direction);
        angles.azimuth_rad += glm::radians(kBeside_deg);
        direction = calibration::direction_of(angles);
    }
    return direction;
}

void RehearsalSource::poll(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples) {
    arriving_.take(now_ns, samples, [this](sim::EyeTracker& tracker) {
        sim::TrueGaze truth;
        for (gaze::EyeRay& ray : truth.eyes) {
            ray.direction = looks_at(tracker.next_s());
            ray.openness = 1.0;
            ray.valid = true;
        }
        return tracker.step(truth, false);
    });
}

std::string RehearsalSource::description() const {
    return "simulated tracker, of who looks at the points";
}

}  // namespace gazeloop::drivers
