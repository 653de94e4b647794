#include "sim/eye_tracker.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <numbers>

#include "runtime/gaze/direction.h"
#include "sim/turned_direction.h"

namespace gazeloop::sim {
namespace {

constexpr double kPupilHidden = 0.7;  // openness below which the lids cover it

SampleLoss loss(const TrackerTerms& terms, double percent, const Random& random) {
    return {percent, terms.dropout_ms * 1e-3 * terms.rate_hz, random};
}

/// Azimuth and elevation rounded to multiples of the step.
glm::dvec3 quantised(const glm::dvec3& direction, double step_rad) {
    const double azimuth = std::atan2(direction.x, -direction.z);
    const double elevation = std::atan2(direction.y, std::hypot(direction.x, direction.z));
    const double a = std::round(azimuth / step_rad) * step_rad;
    const double e = std::round(elevation / step_rad) * step_rad;
    return {std::sin(a) * std::cos(e), std::sin(e), -std::cos(a) * std::cos(e)};
}

}  // namespace

EyeTracker::EyeTracker(const TrackerTerms& terms, std::uint64_t seed, std::int64_t start_ns)
    : terms_(terms),
      start_ns_(start_ns),
      delay_ns_(std::llround(terms.delay_ms * 1e6)),
      arrived_before_ns_(start_ns),
      noise_{Random(seed, Stream::Noise, 0), Random(seed, Stream::Noise, 1)},
      jitter_(seed, Stream::Jitter),
      dropouts_(loss(terms, terms.dropout_percent, Random(seed, Stream::Dropouts))),
      eye_losses_{
          loss(terms, terms.eye_loss_percent, Random(seed, Stream::EyeLosses, 0)),
          loss(terms, terms.eye_loss_percent, Random(seed, Stream::EyeLosses, 1)),
      } {
    if (terms_.bias_deg > 0.0) {
        // A Rayleigh value's median is sqrt(2 ln 2) of the SD on each axis.
        const double sd_rad = glm::radians(terms_.bias_deg) / std::sqrt(2.0 * std::numbers::ln2);
        for (std::size_t eye = 0; eye < bias_.size(); ++eye) {
            Random random(seed, Stream::Bias, eye);
            bias_[eye].right_rad = sd_rad * random.normal();
            bias_[eye].up_rad = sd_rad * random.normal();
        }
    }
    schedule();
}

void EyeTracker::schedule() {
    // Exact while a double counts single nanoseconds: 104 days; to 1 us at the end of host time.
    const double device_ns = static_cast<double>(sequence_) * 1e9 / terms_.rate_hz;
    const double elapsed_ns = device_ns / (1.0 + terms_.clock_ppm * 1e-6);
    constexpr auto kEnd = std::numeric_limits<std::int64_t>::max();
    constexpr double kTooLong_ns = 9.2e18;
    if (std::max(device_ns, elapsed_ns) >= kTooLong_ns) {
        finished_ = true;
        return;
    }
    const std::int64_t taken_ns = std::llround(elapsed_ns);
    if (start_ns_ > 0 && taken_ns > kEnd - start_ns_ - delay_ns_) {
        finished_ = true;
        return;
    }
    next_device_ns_ = std::llround(device_ns);
    next_s_ = elapsed_ns * 1e-9;
    next_ns_ = start_ns_ + taken_ns;
    earliest_arrival_ns_ = next_ns_ + delay_ns_;
}

gaze::EyeRay EyeTracker::measured(const gaze::EyeRay& truth, std::size_t eye, bool lost) {
    gaze::EyeRay ray = truth;
    Offset error = bias_[eye];
    if (terms_.bias_deg > 0.0 || terms_.noise_deg > 0.0) {
        const glm::dvec3& d = truth.direction;
        const double off_axis_deg = glm::degrees(std::atan2(std::hypot(d.x, d.y), -d.z));
        const double bias = 1.0 + terms_.bias_growth_percent * 0.01 * off_axis_deg;
        error = {bias * error.right_rad, bias * error.up_rad};
        if (terms_.noise_deg > 0.0) {
            const double sd_rad = glm::radians(terms_.noise_deg) *
                                  (1.0 + terms_.noise_growth_percent * 0.01 * off_axis_deg);
            error.right_rad += sd_rad * noise_[eye].normal();
            error.up_rad += sd_rad * noise_[eye].normal();
            ray.covariance = {sd_rad * sd_rad, 0.0, sd_rad * sd_rad};
        }
        ray.direction = turned_direction(d, error.right_rad, error.up_rad);
    }
    if (terms_.quantum_deg > 0.0) {
        ray.direction = quantised(ray.direction, glm::radians(terms_.quantum_deg));
    }
    if (lost || truth.openness < kPupilHidden) {
        ray.valid = false;
        ray.confidence = 0.0;
        ray.direction = gaze::kStraightAhead;
        ray.covariance.reset();
    }
    if (lost) {
        ray.openness = -1.0;
    }
    return ray;
}

std::optional<gaze::GazeSample> EyeTracker::step(Person& person) {
    return step(person.at(next_s_), person.head_moves());
}

std::optional<gaze::GazeSample> EyeTracker::step(const TrueGaze& truth, bool head_moves) {
    gaze::GazeSample sample;
    sample.sequence = sequence_;
    sample.device_ns = next_device_ns_;
    sample.sampled = {next_ns_, time::StampKind::Modelled};
    sample.processing = gaze::GazeProcessing::Raw;
    std::int64_t arrived_ns = earliest_arrival_ns_;
    if (terms_.jitter_ms > 0.0) {
        const std::int64_t late_ns = std::llround(jitter_.exponential(terms_.jitter_ms) * 1e6);
        arrived_ns += std::min(late_ns, std::numeric_limits<std::int64_t>::max() -
                                            std::max<std::int64_t>(arrived_ns, 0));
    }
    for (std::size_t eye = 0; eye < sample.eyes.size(); ++eye) {
        sample.eyes[eye] = measured(truth.eyes[eye], eye, eye_losses_[eye].next());
    }
    if (head_moves) {
        sample.head = truth.head;
    }
    ++sequence_;
    schedule();
    if (dropouts_.next()) {
        return std::nullopt;
    }
    arrived_before_ns_ = std::max(arrived_before_ns_, arrived_ns);
    sample.arrived = {arrived_before_ns_, time::StampKind::Modelled};
    return sample;
}

}  // namespace gazeloop::sim
