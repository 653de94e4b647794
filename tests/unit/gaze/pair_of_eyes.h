#pragma once

#include <cmath>
#include <cstddef>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <vector>

#include "runtime/gaze/gaze_sample.h"

namespace gazeloop::gaze {

inline glm::dvec3 looking(double right_deg, double up_deg) {
    const double right = glm::radians(right_deg);
    const double up = glm::radians(up_deg);
    return {std::sin(right) * std::cos(up), std::sin(up), -std::cos(right) * std::cos(up)};
}

/// Eyes that look about, some 9 degrees to all sides, and meet at an angle; 120 Hz.
inline std::vector<GazeSample> pair_of_eyes(double vergence_deg = 2.4, std::size_t count = 400,
                                            double off_deg = 3.0) {
    std::vector<GazeSample> samples(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double phase = 2.0 * std::numbers::pi * static_cast<double>(i) / 97.0;
        const double right_deg = off_deg + 9.0 * std::sin(phase);
        const double up_deg = 4.0 * std::cos(1.7 * phase);
        GazeSample& sample = samples[i];
        sample.sequence = i;
        sample.sampled = {static_cast<std::int64_t>(i) * 8'333'333, time::StampKind::Modelled};
        sample.eyes[0] = {.origin_m = {-0.033, 0.002, 0.029},
                          .direction = looking(right_deg + vergence_deg / 2.0, up_deg),
                          .valid = true};
        sample.eyes[1] = {.origin_m = {0.031, 0.001, 0.029},
                          .direction = looking(right_deg - vergence_deg / 2.0, up_deg),
                          .valid = true};
    }
    return samples;
}

/// Changes both rays of each sample.
template <typename Change>
std::vector<GazeSample> changed(std::vector<GazeSample> samples, Change change) {
    for (GazeSample& sample : samples) {
        change(sample.eyes[0], sample.eyes[1]);
    }
    return samples;
}

}  // namespace gazeloop::gaze
