#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "runtime/gaze/gaze_sample.h"
#include "runtime/gaze/sample_range.h"

namespace gazeloop::gaze {

/// How finely a tracker resolves an eye that rests, degrees, from windows of kQualityWindow_ms in
/// which it was seen all the time: medians over the stiller half of the windows, since in the other
/// half the eye moved.
struct EyePrecision {
    std::size_t windows = 0;            ///< that were looked at, moving ones too
    double sample_to_sample_deg = 0.0;  ///< root mean square of the steps from sample to sample
    double deviation_deg = 0.0;         ///< root mean square of the distances from the mean
    /// The ellipse that holds 68.2 % of the directions where they are spread normally (bivariate
    /// contour ellipse area), deg^2.
    double bcea_deg2 = 0.0;
    /// Of sample to sample and deviation, in each window: 1.41 for noise of which each sample is
    /// new; less where samples follow each other, as filters and drifts make them (Niehorster et
    /// al. 2020, Behavior Research Methods 52:2515).
    double step_per_deviation = 0.0;
};

/// Times without any valid eye, between samples that have one: blinks and losses.
struct Losses {
    std::size_t count = 0;
    double median_ms = 0.0;
    double longest_ms = 0.0;
    double percent = 0.0;       ///< of the time
    std::size_t as_blinks = 0;  ///< that last as long as blinks do, 100 to 400 ms
};

/// How evenly samples come, ms.
struct Intervals {
    double median_ms = 0.0;
    double p05_ms = 0.0;
    double p95_ms = 0.0;
    double missing_percent = 0.0;  ///< of the samples that the rate asks for, not there
};

/// What a researcher asks of a recording before trusting it.
struct GazeQuality {
    double duration_s = 0.0;
    std::optional<Intervals> intervals;             ///< none: fewer than two samples with a time
    std::optional<Losses> losses;                   ///< likewise
    PerEye<std::optional<EyePrecision>> precision;  ///< none: no window
};

inline constexpr double kQualityWindow_ms = 200.0;
inline constexpr double kShortestBlink_ms = 100.0;
inline constexpr double kLongestBlink_ms = 400.0;

/// Of samples in the order of their times, at that rate (sample_rate.h); those whose time is
/// unknown or goes back are left out. An eye rests where its gaze rests in the world, where the
/// head is known: while the head turns, it turns in the head.
[[nodiscard]] GazeQuality gaze_quality(const SampleRange& samples, double rate_hz);

}  // namespace gazeloop::gaze
