#include "sim/fixational_motion.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "runtime/gaze/main_sequence.h"
#include "sim/random.h"
#include "sim/room_for_plans.h"

namespace gazeloop::sim {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// The expected variance of a sine of amplitude 1 and random phase about its mean over a window.
double variance_within(double hz, double window_s) {
    const double x = std::numbers::pi * hz * window_s;
    const double mean_factor = std::sin(x) / x;
    return 0.5 * (1.0 - mean_factor * mean_factor);
}

}  // namespace

FixationalMotion::FixationalMotion(const EyeTerms& terms, std::uint64_t seed)
    : terms_(terms), seed_(seed) {
    if (terms_.drift_deg > 0.0) {
        constexpr double kWindow_s = 0.224;
        Random random(seed_, Stream::Drift);
        double variance = 0.0;
        for (Drift* const drift : {&right_, &up_}) {
            double octave_hz = 1.0;
            for (Sine& sine : *drift) {
                const double hz = octave_hz * random.uniform(0.8, 1.2);
                sine = {.amplitude_rad = 1.0 / hz,
                        .angular_hz = kTwoPi * hz,
                        .phase_rad = random.uniform(0.0, kTwoPi)};
                variance += variance_within(hz, kWindow_s) / (hz * hz);
                octave_hz *= 2.0;
            }
        }
        const double scale = glm::radians(terms_.drift_deg) / std::sqrt(variance);
        for (Drift* const drift : {&right_, &up_}) {
            for (Sine& sine : *drift) {
                sine.amplitude_rad *= scale;
            }
        }
    }
    if (terms_.microsaccades_per_s > 0.0) {
        microsaccades_.reserve(room_for_plans(terms_.microsaccades_per_s));
        microsaccades_.push_back({});  // before the first one: at the centre
        add_microsaccade();
    }
}

double FixationalMotion::sum(const Drift& drift, double time_s) {
    double angle_rad = 0.0;
    for (const Sine& sine : drift) {
        angle_rad += sine.amplitude_rad * std::sin(sine.angular_hz * time_s + sine.phase_rad);
    }
    return angle_rad;
}

void FixationalMotion::plan_until(double time_s) {
    if (terms_.microsaccades_per_s > 0.0) {
        while (time_s >= microsaccades_.back().begin_s) {
            add_microsaccade();
        }
    }
}

void FixationalMotion::add_microsaccade() {
    const Microsaccade& last = microsaccades_.back();
    Random random(seed_, Stream::Microsaccades, microsaccades_.size());
    const double begin_s =
        last.begin_s + last.duration_s + random.exponential(1.0 / terms_.microsaccades_per_s);
    const double amplitude_deg = 0.1 * std::pow(10.0, random.uniform());
    // From the centre itself, atan2 gives some direction: any will do.
    const double back_rad = std::atan2(-last.to.up_deg, -last.to.right_deg);
    const double direction_rad = back_rad + random.uniform(-1.0, 1.0) * std::numbers::pi / 3.0;
    const Offset to{last.to.right_deg + amplitude_deg * std::cos(direction_rad),
                    last.to.up_deg + amplitude_deg * std::sin(direction_rad)};
    microsaccades_.push_back({.begin_s = begin_s,
                              .duration_s = gaze::main_sequence(amplitude_deg).duration_s,
                              .from = last.to,
                              .to = to});
}

FixationalOffset FixationalMotion::at(double time_s) const {
    FixationalOffset offset;
    if (terms_.drift_deg > 0.0) {
        offset.right_rad = sum(right_, time_s);
        offset.up_rad = sum(up_, time_s);
    }
    if (terms_.microsaccades_per_s > 0.0) {
        const auto after = std::upper_bound(
            microsaccades_.begin(), microsaccades_.end(), time_s,
            [](double time, const Microsaccade& one) { return time < one.begin_s; });
        const Microsaccade& last = *(after - 1);
        double done = 1.0;
        if (time_s < last.begin_s + last.duration_s) {
            const double t = (time_s - last.begin_s) / last.duration_s;
            done = t * t * (3.0 - 2.0 * t);  // peak over mean velocity 1.5, as at .1 to 1 deg
            offset.microsaccade = true;
        }
        offset.right_rad +=
            glm::radians(last.from.right_deg + done * (last.to.right_deg - last.from.right_deg));
        offset.up_rad +=
            glm::radians(last.from.up_deg + done * (last.to.up_deg - last.from.up_deg));
    }
    return offset;
}

}  // namespace gazeloop::sim
