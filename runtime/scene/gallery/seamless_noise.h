#pragma once

#include <cmath>
#include <cstdint>

#include "runtime/scene/mesh/place_hash.h"

namespace gazeloop::scene::gallery {

/// Smooth noise in [0, 1] over (u, v) that repeats with period 1, of `cells` cells a period.
inline double seamless_noise(double u, double v, std::int32_t cells_u, std::int32_t cells_v,
                             std::uint32_t seed) {
    const double x = (u - std::floor(u)) * cells_u;
    const double y = (v - std::floor(v)) * cells_v;
    const auto i = static_cast<std::int32_t>(x);
    const auto j = static_cast<std::int32_t>(y);
    const auto smooth = [](double t) { return t * t * t * (t * (6.0 * t - 15.0) + 10.0); };
    const double s = smooth(x - i);
    const double t = smooth(y - j);
    const auto at = [&](std::int32_t dx, std::int32_t dy) {
        return mesh::hashed((i + dx) % cells_u, (j + dy) % cells_v, seed);
    };
    return std::lerp(std::lerp(at(0, 0), at(1, 0), s), std::lerp(at(0, 1), at(1, 1), s), t);
}

/// Octaves of seamless_noise, each twice as fine and half as strong; in [0, 1].
inline double seamless_octaves(double u, double v, std::int32_t cells, int octaves,
                               std::uint32_t seed) {
    double sum = 0.0;
    double weight = 0.5;
    double weights = 0.0;
    for (int octave = 0; octave < octaves; ++octave) {
        sum += weight * seamless_noise(u, v, cells << octave, cells << octave,
                                       seed + static_cast<std::uint32_t>(octave));
        weights += weight;
        weight *= 0.5;
    }
    return sum / weights;
}

}  // namespace gazeloop::scene::gallery
