#include "runtime/gaze/gaze_quality.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "runtime/gaze/direction.h"
#include "runtime/memory/long_vector.h"

namespace gazeloop::gaze {
namespace {

/// The longest step within a window: of trackers that come evenly less than two intervals, else a
/// little more than what is usual.
double longest_step_ms(const Intervals& intervals) {
    return std::max(1.75 * intervals.median_ms, 1.25 * intervals.p95_ms);
}

double at_share(memory::LongVector<double>& values, double share) {
    const auto place =
        values.begin() +
        static_cast<std::ptrdiff_t>(std::llround(share * static_cast<double>(values.size() - 1)));
    std::ranges::nth_element(values, place);
    return *place;
}

double ms(std::int64_t ns) { return static_cast<double>(ns) * 1e-6; }

/// Calls `look` with each sample whose time is known and later than the last one's.
void each_in_order(const SampleRange& samples, const auto& look) {
    std::optional<std::int64_t> last_ns;
    for (const GazeSample& sample : samples) {
        if (sample.sampled.known() && (!last_ns || sample.sampled.ns > *last_ns)) {
            look(sample);
            last_ns = sample.sampled.ns;
        }
    }
}

/// Between samples in order, ms.
struct Steps {
    memory::LongVector<double> ms;
    std::int64_t first_ns = 0;
    std::int64_t last_ns = 0;

    [[nodiscard]] std::int64_t span_ns() const { return last_ns - first_ns; }
};

Steps steps_of(const SampleRange& samples) {
    Steps steps;
    bool any = false;
    each_in_order(samples, [&](const GazeSample& sample) {
        const std::int64_t now_ns = sample.sampled.ns;
        if (std::exchange(any, true)) {
            steps.ms.push_back(ms(now_ns - steps.last_ns));
        } else {
            steps.first_ns = now_ns;
        }
        steps.last_ns = now_ns;
    });
    return steps;
}

Intervals intervals_of(Steps& steps, double rate_hz) {
    Intervals intervals{.median_ms = at_share(steps.ms, 0.5),
                        .p05_ms = at_share(steps.ms, 0.05),
                        .p95_ms = at_share(steps.ms, 0.95)};
    const double asked_for = ms(steps.span_ns()) * 1e-3 * rate_hz;
    if (asked_for > 0.0) {
        const double there = static_cast<double>(steps.ms.size());
        intervals.missing_percent = std::max(0.0, 100.0 * (1.0 - there / asked_for));
    }
    return intervals;
}

/// Gathers losses from samples in order.
class LossesSeen {
  public:
    void add(const GazeSample& sample) {
        if (!sample.eyes[0].valid && !sample.eyes[1].valid) {
            lost_ = true;
            return;
        }
        if (lost_ && seen_ns_) {
            const double length_ms = ms(sample.sampled.ns - *seen_ns_);
            lengths_ms_.push_back(length_ms);
            all_ms_ += length_ms;
            losses_.as_blinks +=
                length_ms >= kShortestBlink_ms && length_ms <= kLongestBlink_ms ? 1U : 0U;
        }
        lost_ = false;
        seen_ns_ = sample.sampled.ns;
    }

    [[nodiscard]] Losses over(std::int64_t span_ns) {
        losses_.count = lengths_ms_.size();
        if (!lengths_ms_.empty()) {
            losses_.median_ms = at_share(lengths_ms_, 0.5);
            losses_.longest_ms = std::ranges::max(lengths_ms_);
            losses_.percent = 100.0 * all_ms_ / ms(span_ns);
        }
        return losses_;
    }

  private:
    Losses losses_;
    memory::LongVector<double> lengths_ms_;
    double all_ms_ = 0.0;
    std::optional<std::int64_t> seen_ns_;  ///< the last sample with a valid eye
    bool lost_ = false;
};

struct Window {
    double step_rad;
    double deviation_rad;
    double bcea_rad2;
};

/// Of n directions about their mean: 2 pi k sqrt(det covariance), where a share of 1 - exp(-k) of a
/// normal distribution lies within.
double bcea_rad2(std::span<const glm::dvec3> directions, const glm::dvec3& mean) {
    constexpr double kShare = 0.682;
    const glm::dvec3 across = perpendicular(mean);
    const glm::dvec3 up = glm::cross(across, mean);
    double xx = 0.0;
    double xy = 0.0;
    double yy = 0.0;
    for (const glm::dvec3& direction : directions) {
        const double x = glm::dot(direction - mean, across);
        const double y = glm::dot(direction - mean, up);
        xx += x * x;
        xy += x * y;
        yy += y * y;
    }
    const auto count = static_cast<double>(directions.size());
    const double determinant = std::max(xx * yy - xy * xy, 0.0) / (count * count);
    return -2.0 * std::numbers::pi * std::log(1.0 - kShare) * std::sqrt(determinant);
}

Window window_of(std::span<const glm::dvec3> directions) {
    glm::dvec3 sum{0.0};
    for (const glm::dvec3& direction : directions) {
        sum += direction;
    }
    const glm::dvec3 mean = unit(sum).value_or(directions.front());
    double steps = 0.0;
    double distances = 0.0;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const double distance = angle_between(directions[i], mean);
        distances += distance * distance;
        if (i > 0) {
            const double step = angle_between(directions[i], directions[i - 1]);
            steps += step * step;
        }
    }
    const auto count = static_cast<double>(directions.size());
    return {std::sqrt(steps / (count - 1.0)), std::sqrt(distances / count),
            bcea_rad2(directions, mean)};
}

/// Gathers an eye's windows from samples in order.
class WindowsSeen {
  public:
    WindowsSeen(std::size_t eye, double longest_ms) : eye_(eye), longest_ms_(longest_ms) {}

    void add(const GazeSample& sample) {
        constexpr std::size_t kFewest = 4;  // samples of a window
        const std::int64_t now_ns = sample.sampled.ns;
        const bool other_frame = sample.head.has_value() != had_head_;
        had_head_ = sample.head.has_value();
        if (other_frame || !sample.eyes[eye_].valid || ms(now_ns - before_ns_) > longest_ms_) {
            directions_.clear();
        }
        before_ns_ = now_ns;
        if (!sample.eyes[eye_].valid) {
            return;
        }
        if (!directions_.empty() && ms(now_ns - begin_ns_) >= kQualityWindow_ms) {
            if (directions_.size() >= kFewest) {
                windows_.push_back(window_of(directions_));
            }
            directions_.clear();
        }
        begin_ns_ = directions_.empty() ? now_ns : begin_ns_;
        const glm::dvec3& in_head = sample.eyes[eye_].direction;
        directions_.push_back(sample.head ? sample.head->orientation * in_head : in_head);
    }

    [[nodiscard]] memory::LongVector<Window> take() { return std::move(windows_); }

  private:
    std::size_t eye_;
    double longest_ms_;
    memory::LongVector<Window> windows_;
    std::vector<glm::dvec3> directions_;
    std::int64_t begin_ns_ = 0;
    std::int64_t before_ns_ = 0;
    bool had_head_ = false;
};

std::optional<EyePrecision> precision_of(memory::LongVector<Window> windows) {
    if (windows.empty()) {
        return std::nullopt;
    }
    EyePrecision precision{.windows = windows.size()};
    std::ranges::sort(windows, {}, &Window::deviation_rad);
    windows.resize((windows.size() + 1) / 2);
    memory::LongVector<double> steps;
    memory::LongVector<double> deviations;
    memory::LongVector<double> areas;
    memory::LongVector<double> ratios;
    for (const Window& window : windows) {
        steps.push_back(window.step_rad);
        deviations.push_back(window.deviation_rad);
        areas.push_back(window.bcea_rad2);
        ratios.push_back(window.deviation_rad > 0.0 ? window.step_rad / window.deviation_rad : 0.0);
    }
    precision.sample_to_sample_deg = glm::degrees(at_share(steps, 0.5));
    precision.deviation_deg = glm::degrees(at_share(deviations, 0.5));
    precision.bcea_deg2 = glm::degrees(glm::degrees(at_share(areas, 0.5)));
    precision.step_per_deviation = at_share(ratios, 0.5);
    return precision;
}

}  // namespace

GazeQuality gaze_quality(const SampleRange& samples, double rate_hz) {
    Steps steps = steps_of(samples);
    GazeQuality quality;
    if (steps.ms.empty()) {
        return quality;
    }
    quality.duration_s = ms(steps.span_ns()) * 1e-3;
    quality.intervals = intervals_of(steps, rate_hz);
    const double longest_ms = longest_step_ms(*quality.intervals);
    LossesSeen losses;
    PerEye<WindowsSeen> windows{WindowsSeen{0, longest_ms}, WindowsSeen{1, longest_ms}};
    each_in_order(samples, [&](const GazeSample& sample) {
        losses.add(sample);
        for (WindowsSeen& eye : windows) {
            eye.add(sample);
        }
    });
    quality.losses = losses.over(steps.span_ns());
    for (const Eye eye : kEyes) {
        quality.precision[index(eye)] = precision_of(windows[index(eye)].take());
    }
    return quality;
}

}  // namespace gazeloop::gaze
