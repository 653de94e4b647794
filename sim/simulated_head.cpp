#include "sim/simulated_head.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "sim/random.h"

namespace gazeloop::sim {
namespace {

constexpr double kPeakOverMean = 1.875;  // of a minimum-jerk course

double minimum_jerk(double t) {
    const double s = std::clamp(t, 0.0, 1.0);
    return s * s * s * (10.0 + s * (-15.0 + s * 6.0));
}

}  // namespace

glm::dquat orientation(const Heading& heading) {
    return glm::angleAxis(heading.yaw_rad, glm::dvec3{0.0, 1.0, 0.0}) *
           glm::angleAxis(heading.pitch_rad, glm::dvec3{1.0, 0.0, 0.0});
}

SimulatedHead::SimulatedHead(const HeadTerms& terms, std::uint64_t seed)
    : terms_(terms), turn_s_(kPeakOverMean / terms.turn_speed_per_s) {
    if (terms_.sway_deg <= 0.0) {
        return;
    }
    constexpr std::array<double, 4> kBands_hz{0.1, 0.3, 0.7, 1.5};
    Random random(seed, Stream::Sway);
    for (Sway* const sway : {&yaw_, &pitch_}) {
        double squares = 0.0;
        for (std::size_t i = 0; i < sway->size(); ++i) {
            const double hz = random.uniform(kBands_hz[i], kBands_hz[i + 1]);
            (*sway)[i] = {.amplitude_rad = 1.0 / hz,
                          .angular_hz = 2.0 * std::numbers::pi * hz,
                          .phase_rad = random.uniform(0.0, 2.0 * std::numbers::pi)};
            squares += 0.5 / (hz * hz);
        }
        const double rms_rad = glm::radians(terms_.sway_deg) * (sway == &yaw_ ? 1.0 : 0.5);
        for (Sine& sine : *sway) {
            sine.amplitude_rad *= rms_rad / std::sqrt(squares);
        }
    }
}

void SimulatedHead::turn(double begin_s, const Heading& by) {
    turns_.push_back({begin_s, rest_, by});
    rest_ = rest_ + by;
}

double SimulatedHead::sum(const Sway& sway, double time_s) {
    double angle_rad = 0.0;
    for (const Sine& sine : sway) {
        angle_rad += sine.amplitude_rad * std::sin(sine.angular_hz * time_s + sine.phase_rad);
    }
    return angle_rad;
}

Heading SimulatedHead::swayed(double time_s) const {
    return terms_.sway_deg > 0.0 ? Heading{sum(yaw_, time_s), sum(pitch_, time_s)} : Heading{};
}

Heading SimulatedHead::turned(double time_s) const {
    // All turns that are over, and the share of those that are not.
    Heading heading;
    auto next = std::upper_bound(turns_.begin(), turns_.end(), time_s,
                                 [](double time, const Turn& turn) { return time < turn.begin_s; });
    while (next != turns_.begin()) {
        --next;
        const double share = minimum_jerk((time_s - next->begin_s) / turn_s_);
        heading = heading + Heading{share * next->by.yaw_rad, share * next->by.pitch_rad};
        if (share == 1.0) {
            return heading + next->before;
        }
    }
    return heading;
}

gaze::Pose SimulatedHead::at(double time_s) const {
    if (!terms_.moves()) {
        return {};
    }
    const glm::dquat turn = orientation(swayed(time_s) + turned(time_s));
    const glm::dvec3 pivot_m{0.0, 0.0, terms_.pivot_m};
    return {turn, pivot_m - turn * pivot_m};
}

}  // namespace gazeloop::sim
