#include "runtime/calibration/eye_calibration.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "runtime/gaze/direction.h"

namespace gazeloop::calibration {
namespace {

constexpr std::size_t kValuesPerEye = 2 * kTerms + 1;
constexpr double kGreatestCoefficient = 100.0;

/// The angles' nearest ones within the reach, on the way to straight ahead.
GazeAngles within(const GazeAngles& angles, double reach_rad) {
    const double radius = std::hypot(angles.azimuth_rad, angles.elevation_rad);
    const double share = radius > reach_rad ? reach_rad / radius : 1.0;
    return {angles.azimuth_rad * share, angles.elevation_rad * share};
}

GazeAngles added(const EyeCalibration& calibration, const GazeAngles& stated) {
    const auto terms = terms_of(within(stated, calibration.reach_rad));
    GazeAngles sum;
    for (std::size_t i = 0; i < kTerms; ++i) {
        sum.azimuth_rad += calibration.azimuth[i] * terms[i];
        sum.elevation_rad += calibration.elevation[i] * terms[i];
    }
    return sum;
}

}  // namespace

GazeAngles angles_of(const glm::dvec3& direction) {
    return {std::atan2(direction.x, -direction.z),
            std::atan2(direction.y, std::hypot(direction.x, direction.z))};
}

glm::dvec3 direction_of(const GazeAngles& angles) {
    const auto [a, e] = angles;
    return {std::sin(a) * std::cos(e), std::sin(e), -std::cos(a) * std::cos(e)};
}

std::array<double, kTerms> terms_of(const GazeAngles& angles) {
    const auto [x, y] = angles;
    return {1.0, x, y, x * x, x * y, y * y};
}

glm::dvec3 corrected(const EyeCalibration& calibration, const glm::dvec3& direction) {
    const GazeAngles stated = angles_of(direction);
    const GazeAngles more = added(calibration, stated);
    constexpr double kUp = std::numbers::pi / 2.0;
    return direction_of({stated.azimuth_rad + more.azimuth_rad,
                         std::clamp(stated.elevation_rad + more.elevation_rad, -kUp, kUp)});
}

std::optional<glm::dvec3> uncorrected(const EyeCalibration& calibration,
                                      const glm::dvec3& direction) {
    constexpr int kMostSteps = 100;
    constexpr double kClose_rad = 1e-9;
    const GazeAngles wanted = angles_of(direction);
    GazeAngles stated = wanted;
    for (int i = 0; i < kMostSteps; ++i) {
        const GazeAngles more = added(calibration, stated);
        stated = {wanted.azimuth_rad - more.azimuth_rad, wanted.elevation_rad - more.elevation_rad};
    }
    const glm::dvec3 found = direction_of(stated);
    const double off_rad = gaze::angle_between(corrected(calibration, found), direction);
    return off_rad <= kClose_rad ? std::optional(found) : std::nullopt;
}

std::string values_text(const Calibration& calibration) {
    std::vector<double> values;
    for (const auto& eye : calibration) {
        const EyeCalibration of_eye = eye.value_or(EyeCalibration{});
        values.insert(values.end(), of_eye.azimuth.begin(), of_eye.azimuth.end());
        values.insert(values.end(), of_eye.elevation.begin(), of_eye.elevation.end());
        values.push_back(of_eye.reach_rad);
    }
    return fmt::format("{}", fmt::join(values, ","));
}

Expected<Calibration> read_values(std::string_view text) {
    const auto refused = [](const std::string& what) {
        return std::unexpected(
            Error{ErrorKind::Usage,
                  fmt::format("calibration values: {}; they are {} numbers with commas between, as "
                              "gazeloop calibrate makes them",
                              what, gaze::kEyeCount * kValuesPerEye)});
    };
    std::vector<double> values;
    while (!text.empty()) {
        double value = 0.0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const auto used = static_cast<std::size_t>(end - text.data());
        if (error != std::errc() || !std::isfinite(value) ||
            (used < text.size() && text[used] != ',')) {
            return refused(fmt::format("number {} is none", values.size() + 1));
        }
        values.push_back(value);
        const bool more = used < text.size();
        text.remove_prefix(used + (more ? 1 : 0));
        if (more && text.empty()) {
            return refused("the last number is missing");
        }
    }
    if (values.size() != gaze::kEyeCount * kValuesPerEye) {
        return refused(fmt::format("{} numbers", values.size()));
    }
    Calibration calibration;
    for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
        const std::span of_eye = std::span(values).subspan(eye * kValuesPerEye, kValuesPerEye);
        const double reach_rad = of_eye.back();
        const bool small = std::ranges::all_of(of_eye.first(2 * kTerms), [](double value) {
            return std::abs(value) <= kGreatestCoefficient;
        });
        if (!small || reach_rad < 0.0 || reach_rad > std::numbers::pi) {
            return refused("a number is out of range");
        }
        if (reach_rad > 0.0) {
            EyeCalibration& stored = calibration[eye].emplace();
            std::ranges::copy(of_eye.first(kTerms), stored.azimuth.begin());
            std::ranges::copy(of_eye.subspan(kTerms, kTerms), stored.elevation.begin());
            stored.reach_rad = reach_rad;
        }
    }
    return calibration;
}

}  // namespace gazeloop::calibration
