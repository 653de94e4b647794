#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "runtime/calibration/eye_calibration.h"
#include "runtime/error.h"

namespace gazeloop::calibration {

/// One eye at one calibration point: unit vectors in the head.
struct CalibrationPoint {
    glm::dvec3 target;
    glm::dvec3 stated;  ///< by the tracker, in fixation
};

struct EyeFit {
    EyeCalibration calibration;
    double before_median_deg = 0.0;  ///< error of what the tracker stated, over the kept points
    /// Error at each kept point of the fit to the other ones: what to expect of gaze elsewhere. At
    /// the outer points that is beyond the others, so it is no less than that.
    double leave_one_out_median_deg = 0.0;
    double leave_one_out_greatest_deg = 0.0;
    std::vector<std::size_t> left_out;  ///< points that the others contradict
};

/// So many points are needed: one more than a quadratic has coefficients, so that each can be left
/// out.
inline constexpr std::size_t kFewestPoints = kTerms + 1;

/// Fits the quadratic of one eye by least squares. A point that was not looked at is left out: the
/// one without which the others agree best, if they then agree at least kAgreeBetter times as well
/// and it lies at least kFarOff_deg off. That is repeated while points remain; of n points at most
/// (n - kFewestPoints) / 2. With fewer than nine no point can be told to be bad.
///
/// Errors (BadInput): too few points, or they lie so that they determine no quadratic (on one line,
/// say).
[[nodiscard]] Expected<EyeFit> fit_eye(std::span<const CalibrationPoint> points);

inline constexpr double kAgreeBetter = 3.0;
inline constexpr double kFarOff_deg = 1.0;

}  // namespace gazeloop::calibration
