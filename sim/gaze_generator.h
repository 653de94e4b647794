#pragma once

#include <cstdint>

#include "drivers/trace/trace.h"

namespace gazeloop::sim {

struct GazeGeneratorConfig {
    std::uint64_t seed = 1;
    double seconds = 60.0;    ///< > 0; at least one sample is made
    double rate_hz = 120.0;   ///< > 0
    double distance_m = 1.5;  ///< > 0: from the head's origin to what both eyes look at
};

/// A plausible recording of a person who looks around: what a perfect tracker without noise or
/// delay would report. The same config gives the same trace.
///
/// - Fixations in world: durations log-normal with a median of 224 ms, a slow drift each.
/// - Saccades on the main sequence, for an amplitude of A degrees: peak velocity
///   596 (1 - exp(-A / 6.47)) deg/s, duration 2.2 A + 21 ms (Carpenter 1988, Movements of the
///   Eyes). Targets lie within 18 deg of where the head points when the saccade starts.
/// - Blinks of 100 to 400 ms, about 15 a minute, without a valid direction.
/// - Head yaw (up to about 40 deg/s) and pitch about a point between the eyes; during fixations the
///   eyes counter-rotate fully (vestibulo-ocular reflex).
/// - Both eyes, at -/+31.5 mm, converge on a point at the distance.
[[nodiscard]] drivers::Trace generate_gaze(const GazeGeneratorConfig& config);

}  // namespace gazeloop::sim
