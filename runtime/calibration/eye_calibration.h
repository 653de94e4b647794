#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/error.h"
#include "runtime/gaze/eye.h"

namespace gazeloop::calibration {

/// Where a direction points in the head: azimuth to the right and elevation, radians.
struct GazeAngles {
    double azimuth_rad = 0.0;    ///< -pi .. pi
    double elevation_rad = 0.0;  ///< -pi/2 .. pi/2
};
[[nodiscard]] GazeAngles angles_of(const glm::dvec3& direction);
[[nodiscard]] glm::dvec3 direction_of(const GazeAngles& angles);

/// 1, x, y, x^2, xy, y^2 of azimuth x and elevation y.
inline constexpr std::size_t kTerms = 6;
[[nodiscard]] std::array<double, kTerms> terms_of(const GazeAngles& angles);

/// What is added to the angles that a tracker states for one eye: a quadratic of them. It is held
/// constant beyond the circle that the calibration points filled, where a quadratic runs away.
struct EyeCalibration {
    std::array<double, kTerms> azimuth{};    ///< coefficients, radians
    std::array<double, kTerms> elevation{};  ///< as above
    double reach_rad = 0.0;                  ///< radius of that circle, about straight ahead

    friend bool operator==(const EyeCalibration&, const EyeCalibration&) = default;
};

/// The corrected direction of a unit vector: a unit vector too.
[[nodiscard]] glm::dvec3 corrected(const EyeCalibration& calibration, const glm::dvec3& direction);

/// The direction that the tracker stated, of one that was corrected: so nothing is lost by it. None
/// where no stated direction, or none that is found by iteration, gives this one to 1e-9 rad.
[[nodiscard]] std::optional<glm::dvec3> uncorrected(const EyeCalibration& calibration,
                                                    const glm::dvec3& direction);

/// Of a person with a device.
using Calibration = gaze::PerEye<std::optional<EyeCalibration>>;

/// As numbers with commas between: of the left eye and then the right one the azimuth's
/// coefficients, the elevation's, and the reach; an eye without calibration has reach 0.
[[nodiscard]] std::string values_text(const Calibration& calibration);
/// Errors (Usage): not so many numbers, not finite, a coefficient beyond +-100 or a reach out of 0
/// to pi.
[[nodiscard]] Expected<Calibration> read_values(std::string_view text);

}  // namespace gazeloop::calibration
