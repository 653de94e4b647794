#include "runtime/gaze/gaze_quality.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <vector>

#include "runtime/gaze/direction.h"
#include "runtime/gaze/sample_rate.h"

namespace gazeloop::gaze {
namespace {

/// The longest step within a window: of trackers that come evenly less than two intervals, else a
/// little more than what is usual.
double longest_step_ms(const Intervals& intervals) {
    return std::max(1.75 * intervals.median_ms, 1.25 * intervals.p95_ms);
}

double at_share(std::vector<double>& values, double share) {
    const auto place =
        values.begin() +
        static_cast<std::ptrdiff_t>(std::llround(share * static_cast<double>(values.size() - 1)));
    std::ranges::nth_element(values, place);
    return *place;
}

double ms(std::int64_t ns) { return static_cast<double>(ns) * 1e-6; }

std::vector<const GazeSample*> in_order(std::span<const GazeSample> samples) {
    std::vector<const GazeSample*> ordered;
    for (const GazeSample& sample : samples) {
        if (sample.sampled.known() &&
            (ordered.empty() || sample.sampled.ns > ordered.back()->sampled.ns)) {
            ordered.push_back(&sample);
        }
    }
    return ordered;
}

Intervals intervals_of(const std::vector<const GazeSample*>& samples, double rate_hz) {
    std::vector<double> steps_ms;
    for (std::size_t i = 1; i < samples.size(); ++i) {
        steps_ms.push_back(ms(samples[i]->sampled.ns - samples[i - 1]->sampled.ns));
    }
    Intervals intervals{.median_ms = at_share(steps_ms, 0.5),
                        .p05_ms = at_share(steps_ms, 0.05),
                        .p95_ms = at_share(steps_ms, 0.95)};
    const double asked_for =
        ms(samples.back()->sampled.ns - samples.front()->sampled.ns) * 1e-3 * rate_hz;
    if (asked_for > 0.0) {
        const double there = static_cast<double>(steps_ms.size());
        intervals.missing_percent = std::max(0.0, 100.0 * (1.0 - there / asked_for));
    }
    return intervals;
}

Losses losses_of(const std::vector<const GazeSample*>& samples) {
    Losses losses;
    std::vector<double> lengths_ms;
    double all_ms = 0.0;
    std::optional<std::int64_t> seen_ns;  // the last sample with a valid eye
    bool lost = false;
    for (const GazeSample* const sample : samples) {
        if (!sample->eyes[0].valid && !sample->eyes[1].valid) {
            lost = true;
            continue;
        }
        if (lost && seen_ns) {
            const double length_ms = ms(sample->sampled.ns - *seen_ns);
            lengths_ms.push_back(length_ms);
            all_ms += length_ms;
            losses.as_blinks +=
                length_ms >= kShortestBlink_ms && length_ms <= kLongestBlink_ms ? 1U : 0U;
        }
        lost = false;
        seen_ns = sample->sampled.ns;
    }
    losses.count = lengths_ms.size();
    if (!lengths_ms.empty()) {
        losses.median_ms = at_share(lengths_ms, 0.5);
        losses.longest_ms = std::ranges::max(lengths_ms);
        losses.percent =
            100.0 * all_ms / ms(samples.back()->sampled.ns - samples.front()->sampled.ns);
    }
    return losses;
}

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

std::optional<EyePrecision> precision_of(const std::vector<const GazeSample*>& samples,
                                         std::size_t eye, double longest_ms) {
    constexpr std::size_t kFewest = 4;  // samples of a window
    std::vector<Window> windows;
    std::vector<glm::dvec3> directions;
    std::int64_t begin_ns = 0;
    std::int64_t before_ns = 0;
    bool had_head = false;
    for (const GazeSample* const sample : samples) {
        const std::int64_t now_ns = sample->sampled.ns;
        const bool other_frame = sample->head.has_value() != had_head;
        had_head = sample->head.has_value();
        if (other_frame || !sample->eyes[eye].valid || ms(now_ns - before_ns) > longest_ms) {
            directions.clear();
        }
        before_ns = now_ns;
        if (!sample->eyes[eye].valid) {
            continue;
        }
        if (!directions.empty() && ms(now_ns - begin_ns) >= kQualityWindow_ms) {
            if (directions.size() >= kFewest) {
                windows.push_back(window_of(directions));
            }
            directions.clear();
        }
        begin_ns = directions.empty() ? now_ns : begin_ns;
        const glm::dvec3& in_head = sample->eyes[eye].direction;
        directions.push_back(sample->head ? sample->head->orientation * in_head : in_head);
    }
    if (windows.empty()) {
        return std::nullopt;
    }
    EyePrecision precision{.windows = windows.size()};
    std::ranges::sort(windows, {}, &Window::deviation_rad);
    windows.resize((windows.size() + 1) / 2);
    std::vector<double> steps;
    std::vector<double> deviations;
    std::vector<double> areas;
    std::vector<double> ratios;
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

GazeQuality gaze_quality(std::span<const GazeSample> samples) {
    const std::vector<const GazeSample*> ordered = in_order(samples);
    GazeQuality quality;
    if (ordered.size() < 2) {
        return quality;
    }
    quality.duration_s = ms(ordered.back()->sampled.ns - ordered.front()->sampled.ns) * 1e-3;
    quality.intervals = intervals_of(ordered, sample_rate_hz(samples));
    quality.losses = losses_of(ordered);
    for (const Eye eye : kEyes) {
        quality.precision[index(eye)] =
            precision_of(ordered, index(eye), longest_step_ms(*quality.intervals));
    }
    return quality;
}

}  // namespace gazeloop::gaze
