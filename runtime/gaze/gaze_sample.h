#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "runtime/gaze/eye.h"
#include "runtime/gaze/pose.h"
#include "runtime/time/stamp.h"

namespace gazeloop::gaze {

/// How far off one reported direction may be: the covariance of its error, rad^2, on the two axes
/// at a right angle to it that gaze/direction_covariance.h names across and up. Positive
/// semidefinite.
struct DirectionCovariance {
    double xx_rad2 = 0.0;  ///< across
    double xy_rad2 = 0.0;
    double yy_rad2 = 0.0;  ///< up

    friend bool operator==(const DirectionCovariance&, const DirectionCovariance&) = default;
};

/// What was done to the directions before they came here, as far as it is stated.
enum class GazeProcessing : std::uint8_t {
    Unknown,
    Raw,       ///< each eye by itself, one exposure
    Fused,     ///< of both eyes, one exposure
    Filtered,  ///< smoothed over time, fused or not: late in saccades
};
inline constexpr std::array<std::string_view, 4> kGazeProcessingNames{"unknown", "raw", "fused",
                                                                      "filtered"};

/// Where one eye looks, in the head frame (+X right, +Y up, -Z forward).
struct EyeRay {
    glm::dvec3 origin_m{0.0};              ///< eye position; zero where the tracker has none
    glm::dvec3 direction{0.0, 0.0, -1.0};  ///< unit vector, meaningful only if valid
    double openness = -1.0;                ///< 0 closed .. 1 open, -1 unknown
    double confidence = -1.0;              ///< 0 .. 1, -1 unknown
    bool valid = false;                    ///< the tracker vouches for the direction
    std::optional<DirectionCovariance> covariance{};  ///< where the device states one
};

/// One report of an eye tracker. Host times are CLOCK_MONOTONIC nanoseconds (virtual time starts
/// at 0); how each was obtained stands beside it.
struct GazeSample {
    std::uint64_t sequence = 0;  ///< counts up by one per report of the source, gaps are losses
    std::int64_t device_ns = 0;  ///< the tracker's own clock, unchanged but for unit and wrap
    time::Stamp sampled;         ///< when the eye was seen (exposure), in host time
    time::Stamp arrived;         ///< when the host had it
    /// When the host could have had it at the earliest: `sampled` plus the tracker's least delay.
    /// Known where a clock was fitted to the tracker's (latency/clock_fit.h); else unknown.
    time::Stamp ready;
    std::optional<std::int64_t> uncertainty_ns;  ///< of `sampled`, either way, where it is known
    PerEye<EyeRay> eyes;
    /// How far off a direction may be because the tracker gives one ray for both eyes. How far away
    /// they look was then assumed, or read from an earlier frame's depth (gaze/combined_gaze.h).
    /// None where each eye has its own ray.
    std::optional<double> parallax_rad;
    std::optional<Pose> head;  ///< head in world at `sampled`, where known
    GazeProcessing processing = GazeProcessing::Unknown;
    bool tracker_gone = false;  ///< no report: the source says that its tracker is gone or failed
};

}  // namespace gazeloop::gaze
