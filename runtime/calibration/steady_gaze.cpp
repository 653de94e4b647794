#include "runtime/calibration/steady_gaze.h"

#include <algorithm>
#include <glm/trigonometric.hpp>

#include "runtime/calibration/eye_calibration.h"
#include "runtime/calibration/median.h"
#include "runtime/gaze/direction.h"

namespace gazeloop::calibration {

std::optional<glm::dvec3> SteadyGaze::rest() const {
    if (directions_.size() < kFewest) {
        return std::nullopt;
    }
    std::vector<double> azimuths;
    std::vector<double> elevations;
    for (const glm::dvec3& direction : directions_) {
        const GazeAngles angles = angles_of(direction);
        azimuths.push_back(angles.azimuth_rad);
        elevations.push_back(angles.elevation_rad);
    }
    const glm::dvec3 middle = direction_of({median(azimuths), median(elevations)});
    std::vector<double> off;
    for (const glm::dvec3& direction : directions_) {
        off.push_back(gaze::angle_between(direction, middle));
    }
    std::vector<double> sorted = off;
    // The median distance of two axes' normal errors is 1.18 of their SD.
    const double sd_rad = median(sorted) / 1.1774;
    if (glm::degrees(sd_rad) > kGreatestSd_deg) {
        return std::nullopt;
    }
    constexpr double kNear = 3.0;
    constexpr double kLeast_rad = 1e-4;  // of a tracker without noise
    const double near_rad = std::max(kNear * sd_rad, kLeast_rad);
    glm::dvec3 sum{0.0};
    std::size_t near = 0;
    for (std::size_t i = 0; i < off.size(); ++i) {
        if (off[i] <= near_rad) {
            sum += directions_[i];
            ++near;
        }
    }
    const auto all = static_cast<double>(directions_.size());
    if (near < kFewest || static_cast<double>(near) < kSteadyShare * all) {
        return std::nullopt;
    }
    return gaze::unit(sum);
}

}  // namespace gazeloop::calibration
