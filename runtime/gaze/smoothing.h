#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "runtime/gaze/events/cyclopean_gaze.h"
#include "runtime/gaze/events/seen_saccades.h"
#include "runtime/gaze/gaze_sample.h"

namespace gazeloop::gaze {

/// Whether somebody between the eye and the loop smooths the gaze.
enum class SmoothingVerdict : std::uint8_t {
    Smoothed,
    NotSmoothed,
    Unclear,         ///< slower than most eyes, but an eye may be so slow
    TooFewSaccades,  ///< fewer than kFewestSaccades
    TooSlow,         ///< the tracker's rate is below kLeastRate_hz
    Repeated,        ///< most samples repeat the one before, so that speeds mean nothing
    NoTimes,         ///< no sample says when the eye was seen
    NoSamples,
};
inline constexpr std::array<std::string_view, 8> kSmoothingVerdictNames{
    "smoothed", "not-smoothed", "unclear",  "too-few-saccades",
    "too-slow", "repeated",     "no-times", "no-samples"};

/// What the peak velocities of saccades say of smoothing.
struct SmoothingFinding {
    SmoothingVerdict verdict = SmoothingVerdict::NoSamples;
    std::size_t saccades = 0;  ///< that were large enough to tell, and looked at
    double rate_hz = 0.0;      ///< of the samples; 0: unknown
    /// Median over saccades of the peak velocity over that of an unsmoothed eye on the main
    /// sequence, seen by the same tracker; 1: as published. Known with a verdict of the first
    /// three.
    std::optional<double> speed{};
    double speed_low = 0.0;  ///< with speed: the 95 % confidence interval of that median
    double speed_high = 0.0;
    /// With Smoothed: the time constant of an exponential filter that slows saccades as much. It
    /// lets the gaze lag by about as much. kLongestTimeConstant_ms: that or more.
    std::optional<double> time_constant_ms{};
    bool in_world = false;     ///< velocities are the gaze's in world; else the eyes' in the head
    double looked_at_s = 0.0;  ///< from the first sample to the last one that was looked at
    bool stopped = false;      ///< kMostSaccades were found, or stop() was called: there was more
};

/// Gathers the event detector's saccades from the samples of a run, in fixed memory and without
/// allocation after construction, and holds their peak velocities against the main sequence
/// (main_sequence.h).
///
/// Low rates and noise change a peak that is computed from samples, so the published curve is not
/// what samples show. Expected peaks are therefore those of simulated saccades on the main
/// sequence, sampled at the same rate, with noise that gives the same resting speeds, and found by
/// the same detector (seeded, a few thousand, when the finding is asked for).
///
/// People differ: published curves saturate at 500 to 700 deg/s, ours at 596 (596 / 500 = 1 / .84).
/// So gaze counts as smoothed only where the median saccade is certainly slower than .8 times the
/// main sequence. A filter that slows saccades less is not told from a slow eye. On simulated gaze
/// of one minute at 90 to 1000 Hz (tests), exponential filters of 20 ms and moving averages of 30
/// ms or more are found, of 10 and 20 ms are not, and unsmoothed gaze is never called smoothed.
class GazeSmoothing {
  public:
    static constexpr std::size_t kFewestSaccades = 20;
    static constexpr std::size_t kMostSaccades = 2000;
    static constexpr double kLeastRate_hz = 80.0;
    static constexpr double kSlowestEye = 0.8;
    static constexpr double kConfidencePercent = 95.0;
    static constexpr double kLongestTimeConstant_ms = 40.0;

    GazeSmoothing();

    /// In the order of arrival.
    void add(const GazeSample& sample);
    /// From here on, heads are given in another world.
    void move_origin();
    /// There are more samples, which nobody will look at.
    void stop() { stopped_ = true; }

    /// Of everything so far. Takes some 50 ms.
    [[nodiscard]] SmoothingFinding finding() const;

  private:
    static constexpr std::size_t kFirstIntervals = 64;

    [[nodiscard]] std::optional<glm::dvec3> direction_of(const GazeSample& sample);
    void lose(std::int64_t time_ns);
    void learn_rate(std::int64_t interval_ns);

    std::optional<std::int64_t> first_ns_;
    std::int64_t last_ns_ = 0;
    std::uint64_t received_ = 0;
    std::uint64_t repeated_ = 0;
    std::vector<std::int64_t> intervals_ns_;  ///< the first ones
    std::int64_t usual_ns_ = 0;               ///< their median; 0: not known yet
    CyclopeanGaze cyclopean_;
    SeenSaccades seen_;
    std::optional<bool> in_world_;
    bool origin_moved_ = false;  ///< since the last sample
    PerEye<glm::dvec3> in_head_{};
    std::vector<SeenSaccade> saccades_;
    bool stopped_ = false;
};

}  // namespace gazeloop::gaze
