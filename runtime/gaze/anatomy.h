#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/gaze/gaze_sample.h"
#include "runtime/gaze/sample_range.h"

namespace gazeloop::gaze {

/// Whether directions and places are those of a pair of eyes in a head: +X right, -Z forward.
enum class AnatomyVerdict : std::uint8_t {
    Agrees,           ///< nothing contradicts, and the eyes were told apart
    Unknown,          ///< one eye, one ray for both, or too few samples
    Behind,           ///< half of the gaze or more points behind the head
    PartlyBehind,     ///< some of it does, or all of one eye's
    OneMirrored,      ///< the eyes move left and right against each other
    OneUpended,       ///< the eyes move up and down against each other
    Diverging,        ///< the rays diverge: their left and right are exchanged
    Exchanged,        ///< the left eye lies right of the right one: columns or left and right are
    PlacesExchanged,  ///< the same, but the rays meet: only the places are exchanged
};

/// The middle of a distribution: robust against blinks, glitches and noise.
struct Quartiles {
    double lower = 0.0;
    double median = 0.0;
    double upper = 0.0;
};

/// What is known of a stream's directions and of the eyes' places.
struct Anatomy {
    AnatomyVerdict verdict = AnatomyVerdict::Unknown;
    PerEye<std::uint64_t> directions{};  ///< valid ones
    PerEye<std::uint64_t> behind{};      ///< of them with +Z
    std::uint64_t shared = 0;            ///< samples with one ray for both eyes
    std::uint64_t pairs = 0;             ///< samples with a ray ahead of each eye's own
    /// By how much the right eye lies right of the left one; none: places that are not known.
    std::optional<double> apart_m;
    /// By how much the left eye looks further right than the right one: positive where rays meet.
    std::optional<Quartiles> vergence_deg;

    [[nodiscard]] bool doubtful() const {
        return verdict != AnatomyVerdict::Agrees && verdict != AnatomyVerdict::Unknown;
    }
};

/// Gathers what a stream says of the eyes. Fixed memory; nothing is allocated after construction.
///
/// Thresholds, and why:
/// - Eyes turn some 55 degrees at most, so no gaze has +Z. kSomeBehind (5 %) lets a live stream's
/// glitches pass;
///   in a trace each of them is taken for no gaze before it is judged. Half of the samples, with
///   all their eyes, or more than half of the directions are no glitches: the axes are others.
/// - Two rays that are looked along diverge in nobody; trackers' errors of .5 to 1 degree an eye
///   make that -1 degree (kDiverging_deg), and three quarters of the samples must be below 0, so
///   that noise about a small vergence decides nothing. Gaze recorded in a headset has medians of 0
///   to .3 degrees with quartiles up to 1 degree off.
/// - A vergence that is mirrored is one that eyes have: below kSquint_deg (-15; mirrored, a point
///   nearer than 24 cm) it is a squint or one eye's error. A smaller squint outwards cannot be told
///   from mirrored directions; what is said names both.
/// - Pupils lie 45 to 80 mm apart: less than kApart_m (20 mm) either way says nothing.
/// - Eyes follow each other, squinting ones too. Left and right they go against each other only in
///   vergence, which stays between 0 and 25 degrees (a point 14 cm away), and up and down hardly at
///   all. One eye is mirrored where the correlation is below kAgainst (-.5) and a tenth of the
///   samples leaves that: below -5 or above 25 degrees; upended, where the heights of the rays
///   differ over more than 10 degrees.
class AnatomyCheck {
  public:
    /// Fewer samples with both eyes say nothing of the pair.
    static constexpr std::size_t kEnough = 20;
    static constexpr double kSomeBehind = 0.05;
    static constexpr double kDiverging_deg = -1.0;
    static constexpr double kSquint_deg = -15.0;
    static constexpr double kApart_m = 0.02;
    static constexpr double kAgainst = -0.5;

    /// Of the samples with both eyes the first `most` are looked at; the others are counted.
    explicit AnatomyCheck(std::size_t most);

    void add(const GazeSample& sample);
    /// Of all samples so far. Sorts what was gathered.
    [[nodiscard]] Anatomy judge();

    /// Samples with a valid eye so far, and of them those with both eyes.
    [[nodiscard]] std::uint64_t samples() const { return samples_; }
    [[nodiscard]] std::uint64_t pairs() const { return facts_.pairs; }

  private:
    struct Pair {
        PerEye<double> right_deg;  ///< where each eye looks
        PerEye<double> up_deg;
    };

    [[nodiscard]] AnatomyVerdict verdict() const;
    [[nodiscard]] bool one_mirrored();
    [[nodiscard]] bool one_upended();
    /// Sorted differences of the eyes.
    void differences(PerEye<double> Pair::* angle);

    Anatomy facts_;
    std::uint64_t samples_ = 0;
    std::uint64_t samples_behind_ = 0;  ///< of them, those with all valid eyes behind
    std::vector<Pair> pairs_;
    std::vector<double> apart_m_;
    std::vector<double> sorted_;
};

/// Of a whole trace; long ones are looked at in equal steps.
[[nodiscard]] Anatomy anatomy_of(const SampleRange& samples);

/// "agree with anatomy (the rays meet, median 2.4 deg)": what was found, one line, no remedy.
[[nodiscard]] std::string anatomy_text(const Anatomy& anatomy);

}  // namespace gazeloop::gaze
