#include "runtime/gaze/smoothing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <random>
#include <tuple>
#include <utility>

#include "runtime/gaze/direction.h"
#include "runtime/gaze/main_sequence.h"
#include "runtime/time/span.h"

namespace gazeloop::gaze {
namespace {

constexpr double kLoss = 1.75;        // a longer interval, in usual ones, has lost a sample
constexpr double kMostRepeats = 0.5;  // of the samples
constexpr double kSmallest_deg = 2.0;
constexpr double kLargest_deg = 30.0;
/// Expected peaks nearer to the threshold would be those that noise has raised.
constexpr double kAboveThreshold = 1.5;
constexpr int kResamples = 1000;
constexpr std::uint64_t kSeed = 20260917;

double median_of(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The engine's numbers are the same everywhere; the library's distributions are not.
class Draws {
  public:
    [[nodiscard]] double uniform() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }
    [[nodiscard]] double normal() {
        return std::sqrt(-2.0 * std::log(1.0 - uniform())) *
               std::cos(2.0 * std::numbers::pi * uniform());
    }
    [[nodiscard]] std::size_t below(std::size_t count) {
        return std::min(static_cast<std::size_t>(uniform() * static_cast<double>(count)),
                        count - 1);
    }

  private:
    std::mt19937_64 engine_{kSeed};
};

/// The tracker that saccades are seen by.
struct Seeing {
    double rate_hz = 0.0;
    double noise_rad = 0.0;  ///< SD of a direction, on each of two axes
};

glm::dvec3 direction_at(const Seeing& tracker, double right_rad, Draws& draws) {
    double up_rad = 0.0;
    if (tracker.noise_rad > 0.0) {
        right_rad += tracker.noise_rad * draws.normal();
        up_rad = tracker.noise_rad * draws.normal();
    }
    return {std::sin(right_rad) * std::cos(up_rad), std::sin(up_rad),
            -std::cos(right_rad) * std::cos(up_rad)};
}

/// The tracker whose white noise lets the gaze rest at the same speed, which grows with the noise.
Seeing seeing(double rate_hz, double resting_deg_per_s, Draws& draws) {
    const Seeing tried{.rate_hz = rate_hz, .noise_rad = glm::radians(0.02)};
    constexpr int kSamples = 4000;
    EventDetector detector(SeenSaccades::kDetector);
    double log_sum = 0.0;
    for (int i = 0; i < kSamples; ++i) {
        detector.add(std::llround(i * 1e9 / rate_hz), direction_at(tried, 0.0, draws));
        log_sum += 2 * i >= kSamples ? std::log(detector.resting_deg_per_s()) : 0.0;
    }
    const double tried_deg_per_s = std::exp(2.0 * log_sum / kSamples);
    return {.rate_hz = rate_hz, .noise_rad = tried.noise_rad * resting_deg_per_s / tried_deg_per_s};
}

/// Medians of what the tracker shows of saccades of one true amplitude on the main sequence, there
/// and back; none where most are not found. `time_constant_s` > 0: through an exponential filter.
std::optional<SeenSaccade> usually_shown(const Seeing& tracker, double amplitude_deg,
                                         double time_constant_s, Draws& draws) {
    constexpr int kSaccades = 40;
    constexpr std::int64_t kFirstRest = 300;  // samples, in which the detector learns the noise
    const SaccadeCourse course(amplitude_deg, 1.0);
    const double interval_s = 1.0 / tracker.rate_hz;
    const double rest_s = 0.16 + 5.0 * time_constant_s;
    const double kept = time_constant_s > 0.0 ? std::exp(-interval_s / time_constant_s) : 0.0;
    SeenSaccades seen;
    double filtered_rad = 0.0;
    std::int64_t sample = 0;
    std::vector<double> amplitudes;
    std::vector<double> peaks;
    const auto now_s = [&] { return static_cast<double>(sample) * interval_s; };
    const auto look = [&](double right_rad) {
        filtered_rad = kept * filtered_rad + (1.0 - kept) * right_rad;
        const auto told =
            seen.add(std::llround(now_s() * 1e9), direction_at(tracker, filtered_rad, draws));
        ++sample;
        if (told && 2.0 * told->amplitude_deg > amplitude_deg) {  // else noise has made it
            amplitudes.push_back(told->amplitude_deg);
            peaks.push_back(told->peak_deg_per_s);
        }
    };
    while (sample < kFirstRest) {
        look(0.0);
    }
    double begin_s = now_s();
    for (int saccade = 0; saccade < kSaccades; ++saccade) {
        begin_s += draws.uniform() * interval_s;
        const double end_s = begin_s + course.duration_s() + rest_s;
        while (now_s() < end_s) {
            const double done = now_s() > begin_s ? course.progress(now_s() - begin_s) : 0.0;
            look(glm::radians(amplitude_deg) * (saccade % 2 == 0 ? done : 1.0 - done));
        }
        begin_s = end_s;
    }
    if (2 * peaks.size() < static_cast<std::size_t>(kSaccades)) {
        return std::nullopt;
    }
    return SeenSaccade{.amplitude_deg = median_of(amplitudes), .peak_deg_per_s = median_of(peaks)};
}

/// The peak velocity that this tracker usually shows for a shown amplitude.
class ExpectedPeaks {
  public:
    ExpectedPeaks(const Seeing& tracker, double time_constant_s, Draws& draws) {
        constexpr int kAmplitudes = 18;
        for (int i = 0; i < kAmplitudes; ++i) {
            const double share = static_cast<double>(i) / (kAmplitudes - 1);
            const double amplitude_deg =
                0.5 * kSmallest_deg * std::pow(2.4 * kLargest_deg / kSmallest_deg, share);
            const auto usual = usually_shown(tracker, amplitude_deg, time_constant_s, draws);
            // Below the first that is found they may come in any order.
            if (usual && (points_.empty() || usual->amplitude_deg > points_.back().amplitude_deg)) {
                points_.push_back(*usual);
            }
        }
    }

    /// Between the simulated amplitudes; none outside.
    [[nodiscard]] std::optional<double> at(double amplitude_deg) const {
        const auto above =
            std::ranges::lower_bound(points_, amplitude_deg, {}, &SeenSaccade::amplitude_deg);
        if (above == points_.begin() || above == points_.end()) {
            return std::nullopt;
        }
        const SeenSaccade& below = *(above - 1);
        const double share =
            (amplitude_deg - below.amplitude_deg) / (above->amplitude_deg - below.amplitude_deg);
        return std::lerp(below.peak_deg_per_s, above->peak_deg_per_s, share);
    }

  private:
    std::vector<SeenSaccade> points_;
};

/// The 2.5th and the 97.5th percentile of the medians of resamples.
std::pair<double, double> interval_of_median(const std::vector<double>& values, Draws& draws) {
    std::vector<double> medians;
    std::vector<double> resample(values.size());
    medians.reserve(kResamples);
    for (int i = 0; i < kResamples; ++i) {
        std::ranges::generate(resample, [&] { return values[draws.below(values.size())]; });
        medians.push_back(median_of(resample));
    }
    std::ranges::sort(medians);
    constexpr double kTail = (100.0 - GazeSmoothing::kConfidencePercent) / 200.0;
    const auto cut = static_cast<std::size_t>(kTail * kResamples);
    return {medians[cut], medians[medians.size() - 1 - cut]};
}

/// The time constant, ms, of the exponential filter through which saccades are `speed` times as
/// fast as without it.
double time_constant_ms(const Seeing& tracker, const ExpectedPeaks& unfiltered,
                        double amplitude_deg, double speed, Draws& draws) {
    constexpr double kLongest_ms = GazeSmoothing::kLongestTimeConstant_ms;
    double shorter_ms = 0.0;
    double shorter_speed = 1.0;
    for (const double longer_ms : {5.0, 10.0, 20.0, kLongest_ms}) {
        const auto usual = usually_shown(tracker, amplitude_deg, longer_ms * 1e-3, draws);
        const auto expected = usual ? unfiltered.at(usual->amplitude_deg) : std::nullopt;
        if (!expected) {
            return longer_ms;
        }
        const double longer_speed = usual->peak_deg_per_s / *expected;
        if (longer_speed <= speed && shorter_speed > longer_speed) {
            return std::lerp(shorter_ms, longer_ms,
                             (shorter_speed - speed) / (shorter_speed - longer_speed));
        }
        shorter_ms = longer_ms;
        shorter_speed = longer_speed;
    }
    return shorter_ms;
}

}  // namespace

GazeSmoothing::GazeSmoothing() {
    intervals_ns_.reserve(kFirstIntervals);
    saccades_.reserve(kMostSaccades);
}

void GazeSmoothing::move_origin() { origin_moved_ = true; }

void GazeSmoothing::lose(std::int64_t time_ns) {
    cyclopean_.add({});
    seen_.add(time_ns, std::nullopt);
}

/// Of both eyes together, in world where the head is known; none where no eye is seen, and where
/// the direction is no sequel to the one before.
std::optional<glm::dvec3> GazeSmoothing::direction_of(const GazeSample& sample) {
    const bool in_world = sample.head.has_value();
    const bool another_frame = in_world != in_world_.value_or(in_world) ||
                               (in_world && std::exchange(origin_moved_, false));
    const glm::dquat to_world =
        in_world ? sample.head->orientation : glm::dquat{1.0, 0.0, 0.0, 0.0};
    PerEye<glm::dvec3> in_head{};
    PerEye<std::optional<glm::dvec3>> eyes;
    bool seen = false;
    for (const Eye eye : kEyes) {
        const EyeRay& ray = sample.eyes[index(eye)];
        if (ray.valid) {
            in_head[index(eye)] = ray.direction;
            eyes[index(eye)] = unit(to_world * ray.direction);
            seen = seen || eyes[index(eye)].has_value();
        }
    }
    if (!seen) {
        return std::nullopt;
    }
    in_world_ = in_world;
    repeated_ += in_head == in_head_ ? 1U : 0U;
    in_head_ = in_head;
    return another_frame ? std::nullopt : cyclopean_.add(eyes);
}

void GazeSmoothing::learn_rate(std::int64_t interval_ns) {
    intervals_ns_.push_back(interval_ns);
    if (intervals_ns_.size() == kFirstIntervals) {
        const auto middle = intervals_ns_.begin() + kFirstIntervals / 2;
        std::nth_element(intervals_ns_.begin(), middle, intervals_ns_.end());
        usual_ns_ = *middle;
    }
}

void GazeSmoothing::add(const GazeSample& sample) {
    if (stopped_) {
        return;
    }
    ++received_;
    if (!sample.sampled.known()) {
        return;
    }
    const std::int64_t now_ns = sample.sampled.ns;
    if (!first_ns_) {
        first_ns_ = now_ns;
        last_ns_ = now_ns;
        return;
    }
    const std::int64_t interval_ns = time::saturated(static_cast<__int128>(now_ns) - last_ns_);
    if (interval_ns <= 0) {
        return;
    }
    last_ns_ = now_ns;
    if (usual_ns_ == 0) {
        learn_rate(interval_ns);
        return;
    }
    const std::optional<glm::dvec3> direction = direction_of(sample);
    if (!direction || static_cast<double>(interval_ns) > kLoss * static_cast<double>(usual_ns_)) {
        lose(now_ns);
        return;
    }
    const auto saccade = seen_.add(now_ns, direction);
    if (saccade && saccade->amplitude_deg >= kSmallest_deg &&
        saccade->amplitude_deg <= kLargest_deg) {
        saccades_.push_back(*saccade);
        stopped_ = saccades_.size() == kMostSaccades;
    }
}

SmoothingFinding GazeSmoothing::finding() const {
    SmoothingFinding finding{.in_world = in_world_.value_or(false), .stopped = stopped_};
    if (received_ == 0) {
        return finding;
    }
    if (!first_ns_) {
        finding.verdict = SmoothingVerdict::NoTimes;
        return finding;
    }
    finding.looked_at_s = static_cast<double>(last_ns_ - *first_ns_) * 1e-9;
    finding.verdict = SmoothingVerdict::TooFewSaccades;
    if (usual_ns_ == 0) {
        return finding;
    }
    finding.rate_hz = 1e9 / static_cast<double>(usual_ns_);
    if (finding.rate_hz < kLeastRate_hz) {
        finding.verdict = SmoothingVerdict::TooSlow;
        return finding;
    }
    if (static_cast<double>(repeated_) > kMostRepeats * static_cast<double>(received_)) {
        finding.verdict = SmoothingVerdict::Repeated;
        return finding;
    }
    if (saccades_.size() < kFewestSaccades) {
        finding.saccades = saccades_.size();
        return finding;
    }
    Draws draws;
    const EventDetector& detector = seen_.detector();
    const Seeing tracker = seeing(finding.rate_hz, detector.resting_deg_per_s(), draws);
    const ExpectedPeaks unfiltered(tracker, 0.0, draws);
    std::vector<double> speeds;
    std::vector<double> amplitudes;
    for (const SeenSaccade& saccade : saccades_) {
        const auto expected = unfiltered.at(saccade.amplitude_deg);
        if (expected && *expected >= kAboveThreshold * detector.begin_deg_per_s()) {
            speeds.push_back(saccade.peak_deg_per_s / *expected);
            amplitudes.push_back(saccade.amplitude_deg);
        }
    }
    finding.saccades = speeds.size();
    if (speeds.size() < kFewestSaccades) {
        return finding;
    }
    std::tie(finding.speed_low, finding.speed_high) = interval_of_median(speeds, draws);
    finding.speed = median_of(speeds);
    if (finding.speed_high < kSlowestEye) {
        finding.verdict = SmoothingVerdict::Smoothed;
        finding.time_constant_ms =
            time_constant_ms(tracker, unfiltered, median_of(amplitudes), *finding.speed, draws);
    } else if (finding.speed_low > kSlowestEye) {
        finding.verdict = SmoothingVerdict::NotSmoothed;
    } else {
        finding.verdict = SmoothingVerdict::Unclear;
    }
    return finding;
}

}  // namespace gazeloop::gaze
