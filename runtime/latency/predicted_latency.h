#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "runtime/latency/gaze_age.h"
#include "runtime/latency/latency_summary.h"

namespace gazeloop::latency {

/// A system's parts in the order in which time passes in them, as in Figure 5 of Guenter et al.
/// 2012 ("Foveated 3D Graphics").
enum class Part : std::uint8_t {
    Tracker,    ///< the eye is seen -> the host can have the sample
    Delivery,   ///< what reaching the host takes on top of it
    Sampling,   ///< a sample waits until it is used: at most until the next one is there
    Phase,      ///< an eye movement that a frame just missed waits for the next frame
    Loop,       ///< the loop's own work, from the latch to the GPU's begin
    Render,     ///< the GPU's work
    Display,    ///< a picture waits for its turn
    Row,        ///< until the fovea's row is lit
    Switching,  ///< until its pixels have switched
};
inline constexpr std::size_t kPartCount = 9;
inline constexpr std::array<std::string_view, kPartCount> kPartNames{
    "tracker", "delivery", "sampling", "phase", "loop", "render", "display", "row", "switching"};

/// What one part takes, nanoseconds. A figure that is not known is absent, never 0.
struct PartRange {
    std::optional<std::int64_t> least_ns{};
    std::optional<std::int64_t> greatest_ns{};
};

/// A sum of parts. Unknown ones are in neither sum, which are then "at least" so much.
struct PredictedSum {
    std::int64_t best_ns = 0;
    std::int64_t worst_ns = 0;
    bool best_at_least = false;
    bool worst_at_least = false;
};

/// The best and the worst case that the figures of a system's parts allow.
struct PredictedLatency {
    std::array<PartRange, kPartCount> parts;  ///< by Part
    /// How old the gaze in a frame is when it is seen: all parts but the phase. The measured gaze
    /// age at display is to be held against this.
    [[nodiscard]] PredictedSum gaze_age() const;
    /// How long after an eye movement the picture follows: all parts.
    [[nodiscard]] PredictedSum eye_to_photon() const;
};

/// What is known of a tracker: from its profile, or from the settings of a simulated one.
struct TrackerFigures {
    std::optional<std::int64_t> delay_ns{};        ///< at the least
    std::optional<std::int64_t> uncertainty_ns{};  ///< of delay_ns, either way
    std::optional<std::int64_t> jitter_ns{};       ///< mean of an exponential delay on top of it
    std::optional<double> rate_hz{};
};

/// Of a run's tracker, its display, its frame period, and its GPU time as measured.
///
/// Delivery reaches to 6.9 times the mean jitter, which only one sample in a thousand exceeds
/// (e^-6.9 = .001). Sampling is up to one period of the tracker, phase up to one frame interval
/// (the median). Render is from the least GPU time to its p99 (or the greatest, where that is
/// withheld). The loop's work is taken for nothing, as the paper takes network and bus.
///
/// A picture waits for the announced middle of the emission for up to one period, as shown_frame()
/// has it. A row is lit up to half of the rolling time before or after the middle
/// (display_profile.h): the best case of both together is a bound that no frame reaches, because a
/// picture must be there before its rows are lit. Persistence shifts no time.
[[nodiscard]] PredictedLatency predicted_latency(const TrackerFigures& tracker,
                                                 const SummaryReport& report);

/// A percentile of what was measured that lies outside what the parts allow.
struct OutsidePrediction {
    std::string_view what;     ///< "min", "p50", "p95", "p99" or "max"
    double measured_ms = 0.0;  ///< of the gaze age at display
    double limit_ms = 0.0;     ///< the best or the worst case
    bool above = true;         ///< else below the best case
    /// The part whose own figure at this percentile is farthest outside its range; none where no
    /// part by itself is.
    std::optional<Part> part{};
    double part_measured_ms = 0.0;  ///< with part
    double part_limit_ms = 0.0;     ///< with part
};

/// The measured row of a part: a stage, or for Loop filter, submit and what is unaccounted.
/// nullptr for Phase, which no frame can measure, and for Loop, which is several rows.
[[nodiscard]] const DurationRow* measured_row(const SummaryReport& report, Part part);

/// What was measured beside what was predicted.
struct PredictionCheck {
    PredictedLatency predicted{};
    std::optional<std::int64_t> tracker_uncertainty_ns{};  ///< of the tracker's delay, either way
    /// Parts that the measured age has and the prediction lacks: it cannot be judged by the worst
    /// case then.
    std::vector<Part> unknown{};
    bool comparable = false;  ///< the measured age is known, and no part is unknown
    std::vector<OutsidePrediction> outside{};
};

[[nodiscard]] PredictionCheck check_prediction(const TrackerFigures& tracker,
                                               const SummaryReport& report);

}  // namespace gazeloop::latency
