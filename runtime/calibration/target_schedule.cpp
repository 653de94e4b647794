#include "runtime/calibration/target_schedule.h"

#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <utility>

#include "runtime/calibration/eye_calibration.h"

namespace gazeloop::calibration {
namespace {

/// Columns and rows, -1 to 1.
constexpr std::array<std::pair<int, int>, 9> kOrder{
    {{0, 0}, {-1, 1}, {0, 1}, {1, 1}, {1, 0}, {1, -1}, {0, -1}, {-1, -1}, {-1, 0}}};

}  // namespace

std::vector<glm::dvec3> TargetSchedule::targets() const {
    std::vector<glm::dvec3> targets;
    for (const auto& [column, row] : kOrder) {
        targets.push_back(direction_of(
            {glm::radians(column * half_width_deg), glm::radians(row * half_height_deg)}));
    }
    return targets;
}

double TargetSchedule::length_s() const { return shown_s * static_cast<double>(kOrder.size()); }

std::optional<TargetSchedule::Shown> TargetSchedule::at(double seconds) const {
    if (!(seconds >= 0.0 && seconds < length_s())) {
        return std::nullopt;
    }
    const double target = std::floor(seconds / shown_s);
    return Shown{.target = static_cast<std::size_t>(target),
                 .settled = seconds - target * shown_s >= settling_s};
}

}  // namespace gazeloop::calibration
