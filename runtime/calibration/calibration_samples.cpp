#include "runtime/calibration/calibration_samples.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>

#include "runtime/gaze/usable_direction.h"

namespace gazeloop::calibration {

void CalibrationSamples::add(const gaze::GazeSample& sample) {
    if (!shown_ || !shown_->settled) {
        return;
    }
    for (const gaze::Eye eye : gaze::kEyes) {
        const gaze::EyeRay& ray = sample.eyes[gaze::index(eye)];
        if (const auto direction = gaze::usable_direction(ray, minimum_confidence_)) {
            steady_[shown_->target][gaze::index(eye)].add(*direction);
        }
    }
}

std::vector<std::size_t> CalibrationSamples::steady_points(gaze::Eye eye) const {
    std::vector<std::size_t> points;
    for (std::size_t point = 0; point < steady_.size(); ++point) {
        if (steady_[point][gaze::index(eye)].rest()) {
            points.push_back(point);
        }
    }
    return points;
}

Expected<EyeFit> CalibrationSamples::fit(gaze::Eye eye) const {
    const std::vector<glm::dvec3> targets = schedule_.targets();
    std::vector<CalibrationPoint> points;
    for (const std::size_t point : steady_points(eye)) {
        points.push_back({targets[point], *steady_[point][gaze::index(eye)].rest()});
    }
    return fit_eye(points);
}

Calibration CalibrationResult::calibration() const {
    Calibration calibration;
    for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
        if (eyes[eye]) {
            calibration[eye] = eyes[eye]->calibration;
        }
    }
    return calibration;
}

CalibrationResult result_of(const CalibrationSamples& samples) {
    CalibrationResult result;
    for (const gaze::Eye eye : gaze::kEyes) {
        const std::size_t i = gaze::index(eye);
        result.points[i] = samples.steady_points(eye);
        if (auto fit = samples.fit(eye)) {
            result.eyes[i] = std::move(*fit);
        } else {
            result.problems[i] = fit.error().message;
        }
    }
    return result;
}

std::string result_text(const CalibrationResult& result) {
    std::string text;
    for (const gaze::Eye eye : gaze::kEyes) {
        const std::size_t i = gaze::index(eye);
        auto out = std::back_inserter(text);
        fmt::format_to(out, "{:<5} eye  ", gaze::kEyeNames[i]);
        if (!result.eyes[i]) {
            fmt::format_to(out, "NOT CALIBRATED: {}\n", result.problems[i]);
            continue;
        }
        const EyeFit& fit = *result.eyes[i];
        fmt::format_to(out,
                       "{} points: {:.2f} deg off before, {:.2f} deg expected after (median, each "
                       "point by the others; the worst {:.2f})",
                       result.points[i].size(), fit.before_median_deg, fit.leave_one_out_median_deg,
                       fit.leave_one_out_greatest_deg);
        std::vector<std::size_t> numbers;
        for (const std::size_t left_out : fit.left_out) {
            numbers.push_back(result.points[i][left_out] + 1);
        }
        if (!numbers.empty()) {
            fmt::format_to(out, "; point {} was left out, the others contradict it",
                           fmt::join(numbers, ", "));
        }
        text += "\n";
    }
    return text;
}

}  // namespace gazeloop::calibration
