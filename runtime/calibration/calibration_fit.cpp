#include "runtime/calibration/calibration_fit.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>
#include <numeric>
#include <optional>

#include "runtime/calibration/median.h"
#include "runtime/gaze/direction.h"

namespace gazeloop::calibration {
namespace {

using Indices = std::vector<std::size_t>;

double error_deg(const EyeCalibration& calibration, const CalibrationPoint& point) {
    return glm::degrees(gaze::angle_between(corrected(calibration, point.stated), point.target));
}

/// The least-squares fit to these of the points; none where they determine none.
std::optional<EyeCalibration> fit(std::span<const CalibrationPoint> points, const Indices& chosen) {
    const auto rows = static_cast<Eigen::Index>(chosen.size());
    Eigen::MatrixXd terms(rows, static_cast<Eigen::Index>(kTerms));
    Eigen::MatrixXd missing(rows, 2);
    EyeCalibration calibration;
    for (Eigen::Index row = 0; row < rows; ++row) {
        const CalibrationPoint& point = points[chosen[static_cast<std::size_t>(row)]];
        const GazeAngles stated = angles_of(point.stated);
        const GazeAngles target = angles_of(point.target);
        const auto of_row = terms_of(stated);
        for (std::size_t i = 0; i < kTerms; ++i) {
            terms(row, static_cast<Eigen::Index>(i)) = of_row[i];
        }
        missing(row, 0) = target.azimuth_rad - stated.azimuth_rad;
        missing(row, 1) = target.elevation_rad - stated.elevation_rad;
        calibration.reach_rad =
            std::max(calibration.reach_rad, std::hypot(stated.azimuth_rad, stated.elevation_rad));
    }
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(terms);
    // Columns are as small as the square of the points' angles; below that it is rounding and
    // noise.
    constexpr double kIndependent = 1e-4;
    solver.setThreshold(kIndependent);
    if (solver.rank() < static_cast<Eigen::Index>(kTerms)) {
        return std::nullopt;
    }
    const Eigen::MatrixXd solved = solver.solve(missing);
    for (std::size_t i = 0; i < kTerms; ++i) {
        calibration.azimuth[i] = solved(static_cast<Eigen::Index>(i), 0);
        calibration.elevation[i] = solved(static_cast<Eigen::Index>(i), 1);
    }
    return calibration;
}

Indices without(const Indices& chosen, std::size_t point) {
    Indices others = chosen;
    std::erase(others, point);
    return others;
}

/// By how much the points disagree: residual per degree of freedom, deg; infinite without a fit.
double disagreement_deg(std::span<const CalibrationPoint> points, const Indices& chosen) {
    const auto fitted = fit(points, chosen);
    if (!fitted || chosen.size() <= kTerms) {
        return std::numeric_limits<double>::infinity();
    }
    double squares = 0.0;
    for (const std::size_t point : chosen) {
        const double error = error_deg(*fitted, points[point]);
        squares += error * error;
    }
    return std::sqrt(squares / static_cast<double>(chosen.size() - kTerms));
}

/// The point that the others contradict; none where there is none.
std::optional<std::size_t> bad_point(std::span<const CalibrationPoint> points,
                                     const Indices& chosen) {
    const double all_deg = disagreement_deg(points, chosen);
    std::size_t worst = 0;
    double best_deg = std::numeric_limits<double>::infinity();
    for (const std::size_t point : chosen) {
        const double others_deg = disagreement_deg(points, without(chosen, point));
        if (others_deg < best_deg) {
            best_deg = others_deg;
            worst = point;
        }
    }
    const auto fitted = fit(points, without(chosen, worst));
    const bool far = fitted && error_deg(*fitted, points[worst]) >= kFarOff_deg;
    return far && kAgreeBetter * best_deg <= all_deg ? std::optional(worst) : std::nullopt;
}

}  // namespace

Expected<EyeFit> fit_eye(std::span<const CalibrationPoint> points) {
    if (points.size() < kFewestPoints) {
        return std::unexpected(
            Error{ErrorKind::BadInput, fmt::format("{} points with steady gaze, {} are needed",
                                                   points.size(), kFewestPoints)});
    }
    EyeFit result;
    Indices chosen(points.size());
    std::iota(chosen.begin(), chosen.end(), std::size_t{0});
    for (std::size_t left = (points.size() - kFewestPoints) / 2; left > 0; --left) {
        const auto bad = bad_point(points, chosen);
        if (!bad) {
            break;
        }
        result.left_out.push_back(*bad);
        chosen = without(chosen, *bad);
    }
    const auto fitted = fit(points, chosen);
    if (!fitted) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  "the points where gaze was steady lie so that they determine no calibration"});
    }
    result.calibration = *fitted;
    std::vector<double> before;
    std::vector<double> left_out_deg;
    for (const std::size_t point : chosen) {
        before.push_back(error_deg({}, points[point]));
        // Without this one they may determine no quadratic: then nothing is known of its error.
        if (auto others = fit(points, without(chosen, point))) {
            others->reach_rad = fitted->reach_rad;
            left_out_deg.push_back(error_deg(*others, points[point]));
        }
    }
    result.before_median_deg = median(before);
    if (left_out_deg.empty()) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  "too few points with steady gaze to say how good the calibration is"});
    }
    result.leave_one_out_median_deg = median(left_out_deg);
    result.leave_one_out_greatest_deg = std::ranges::max(left_out_deg);
    return result;
}

}  // namespace gazeloop::calibration
