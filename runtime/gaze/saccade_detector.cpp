#include "runtime/gaze/saccade_detector.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace gazeloop::gaze {
namespace {

constexpr double kHalfWindow_s = 0.005;
constexpr std::int64_t kSettle_ns = 50'000'000;
constexpr std::int64_t kLongest_ns = 300'000'000;
constexpr double kFastest_deg_per_s = 1200.0;

// Over the median of a Rayleigh distribution: its mean and so many standard deviations. And the
// least, because drift and pursuit are no saccades however still the tracker is.
constexpr double kPeakOverMedian = (1.2533 + 6.0 * 0.6551) / 1.1774;
constexpr double kEdgeOverMedian = (1.2533 + 3.0 * 0.6551) / 1.1774;
constexpr double kLeastPeak_deg_per_s = 45.0;
constexpr double kLeastEdge_deg_per_s = 20.0;

constexpr std::uint64_t kFirstRests = 20;  // speeds before the thresholds mean anything
constexpr double kLeastGain = 0.005;       // of the median, per sample

}  // namespace

double angle_between_deg(const glm::dvec3& a, const glm::dvec3& b) {
    // The chord, because a dot product loses small angles; mostly it is short enough for two terms.
    const double chord = glm::distance(a, b);
    constexpr double kShort = 0.05;
    return glm::degrees(chord < kShort ? chord * (1.0 + chord * chord / 24.0)
                                       : 2.0 * std::asin(std::min(0.5 * chord, 1.0)));
}

SaccadeDetector::SaccadeDetector(double rate_hz)
    : rate_hz_(rate_hz),
      half_(std::clamp<std::size_t>(static_cast<std::size_t>(std::lround(rate_hz * kHalfWindow_s)),
                                    1, kGreatestHalf)) {}

SaccadeDetector::SaccadeDetector(double rate_hz, double resting_deg_per_s)
    : SaccadeDetector(rate_hz) {
    rested_ = kFirstRests;
    resting_deg_per_s_ = resting_deg_per_s;
    set_thresholds();
    fixed_ = true;
}

double SaccadeDetector::window_s() const { return 2.0 * static_cast<double>(half_) / rate_hz_; }

void SaccadeDetector::set_thresholds() {
    threshold_deg_per_s_ = std::max(kPeakOverMedian * resting_deg_per_s_, kLeastPeak_deg_per_s);
    edge_deg_per_s_ = std::max(kEdgeOverMedian * resting_deg_per_s_, kLeastEdge_deg_per_s);
}

/// One step of a running median (Ma, Muthukrishnan and Sandler 2013, "Frugal streaming").
void SaccadeDetector::follow(double speed_deg_per_s) {
    if (fixed_) {
        return;
    }
    if (rested_ == 0) {
        resting_deg_per_s_ = speed_deg_per_s;
    }
    ++rested_;
    const double gain = std::max(1.0 / static_cast<double>(rested_), kLeastGain);
    // From a standing gaze's 0 no factor leads away.
    constexpr double kLeast_deg_per_s = 0.01;
    resting_deg_per_s_ =
        std::max(resting_deg_per_s_ *
                     (speed_deg_per_s > resting_deg_per_s_ ? 1.0 + gain : 1.0 / (1.0 + gain)),
                 kLeast_deg_per_s);
    set_thresholds();
}

const SaccadeDetector::Point& SaccadeDetector::back(std::size_t samples) const {
    return ring_[(place_ - 1 - samples) % kRing];
}

glm::dvec3 SaccadeDetector::mean_of(std::size_t oldest, std::size_t newest) const {
    glm::dvec3 sum{0.0};
    for (std::size_t samples = newest; samples <= oldest; ++samples) {
        sum += back(samples).direction;
    }
    return glm::normalize(sum);
}

glm::dvec3 SaccadeDetector::mean_before(std::size_t samples) const {
    return mean_of(samples + half_, samples);
}

glm::dvec3 SaccadeDetector::mean_after(std::size_t samples) const {
    return mean_of(samples, samples - half_);
}

void SaccadeDetector::break_off() {
    held_ = 0;
    moving_.reset();
    ended_.reset();
}

std::optional<SeenSaccade> SaccadeDetector::add(std::int64_t time_ns, const glm::dvec3& direction) {
    if (held_ == 0) {
        unbroken_since_ns_ = time_ns;
    }
    ring_[place_ % kRing] = {time_ns, direction};
    ++place_;
    ++held_;
    std::optional<SeenSaccade> told;
    if (ended_ && time_ns - ended_->end_ns >= kSettle_ns) {
        told = ended_->saccade;
        ended_.reset();
    }
    // The one before the window's middle is needed too, with its half window.
    if (held_ < 2 * half_ + 2) {
        return told;
    }
    const Point& first = back(2 * half_);
    const Point& middle = back(half_);
    const double window_s = static_cast<double>(time_ns - first.time_ns) * 1e-9;
    const double speed = angle_between_deg(first.direction, direction) / window_s;
    if (rested_ < kFirstRests) {
        follow(speed);
        return told;
    }
    if (!moving_) {
        if (speed < edge_deg_per_s_) {
            follow(speed);
        } else {
            moving_ = Moving{.begin_ns = middle.time_ns,
                             .from = mean_before(half_ + 1),
                             .peak_deg_per_s = speed};
        }
        return told;
    }
    moving_->peak_deg_per_s = std::max(moving_->peak_deg_per_s, speed);
    const bool lasts = middle.time_ns - moving_->begin_ns > kLongest_ns;
    if (lasts) {
        // Noise, or a slow movement: what the gaze rests at is more than was thought.
        follow(speed);
    }
    if (speed >= edge_deg_per_s_) {
        return told;
    }
    if (!lasts && moving_->peak_deg_per_s >= threshold_deg_per_s_ &&
        moving_->peak_deg_per_s <= kFastest_deg_per_s &&
        moving_->begin_ns - unbroken_since_ns_ >= kSettle_ns) {
        ended_ =
            Ended{.end_ns = middle.time_ns,
                  .saccade = {.amplitude_deg = angle_between_deg(moving_->from, mean_after(half_)),
                              .peak_deg_per_s = moving_->peak_deg_per_s}};
    }
    moving_.reset();
    return told;
}

}  // namespace gazeloop::gaze
