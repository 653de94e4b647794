#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/error.h"
#include "runtime/probe/light_levels.h"

namespace gazeloop::probe {

/// A light that goes on or off. Times are in frames: frame i is exposed from i to i + 1, so that a
/// light that goes on in the middle of that exposure has the time i + 0.5.
struct LightChange {
    bool on = false;
    double frame = 0.0;
};

/// What one light did in a video.
struct LightChanges {
    LightLevels levels;
    /// It comes in pulses, as most headsets' displays do, or as a lamp that is dimmed does.
    bool pulsed = false;
    std::optional<double> pulse_period_frames{};  ///< where it is pulsed
    /// On and off by turns. What a light did before the first frame or after the last is unknown:
    /// the state in which the video begins is no change, nor is a last one that cannot be told from
    /// a gap.
    std::vector<LightChange> changes;
    std::uint64_t glitches = 0;  ///< flashes shorter than kLeastState_s, left out
};

/// A light keeps a state for at least so long: longer than the gap between two pulses of a display
/// of 50 Hz or more, or than a flash of a mains-driven light, and shorter than the lamp is
/// switched.
inline constexpr double kLeastState_s = 0.04;

/// Finds when a light is switched, by two thresholds between its levels. The time of a change is
/// that of a step which gives the frames the same light as the change did, so that it is exact
/// below a frame where an exposure sees a part of it, and the middle of a ramp that is slow. A
/// pulsed light goes on with the middle of its first pulse, and off where the pulse after its last
/// would have been. Errors (BadInput): the light is never switched.
///
/// Precondition: camera_fps > 0. Memory: of the changes alone.
[[nodiscard]] Expected<LightChanges> find_changes(const LightSeries& series, Light light,
                                                  double camera_fps);

}  // namespace gazeloop::probe
