#include "runtime/openxr_layer/gaze_history.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/gaze/combined_gaze.h"
#include "runtime/gaze/usable_direction.h"
#include "runtime/time/span.h"

namespace gazeloop::openxr_layer {
namespace {

/// Two samples farther apart say nothing of how fast the eye turns.
constexpr std::int64_t kLongestStep_ns = 50'000'000;

std::int64_t apart_ns(std::int64_t a, std::int64_t b) {
    return time::saturated(static_cast<__int128>(a) - b);
}

/// Midway between the eyes where the tracker says where they are, else the head's origin.
glm::dvec3 origin_of(const gaze::GazeSample& sample) {
    return 0.5 * (gaze::in_the_head(sample.eyes[0].origin_m) +
                  gaze::in_the_head(sample.eyes[1].origin_m));
}

/// An angle from -180 to 180 degrees.
struct Turn {
    double cos = 1.0;
    double sin = 0.0;
};

/// Without trigonometry, since each sample needs it and finds nothing of it in the caches.
Turn half_of(const Turn& turn) {
    if (turn.cos >= 0.0) {
        const double cos = std::sqrt(0.5 * (1.0 + turn.cos));
        return {.cos = cos, .sin = turn.sin / (2.0 * cos)};
    }
    const double sin = std::copysign(std::sqrt(0.5 * (1.0 - turn.cos)), turn.sin);
    return {.cos = turn.sin / (2.0 * sin), .sin = sin};
}

/// Of the eyes with that confidence at the least.
gaze::PerEye<std::optional<glm::dvec3>> directions_of(const gaze::GazeSample& sample,
                                                      double confidence) {
    return {gaze::usable_direction(sample.eyes[0], confidence),
            gaze::usable_direction(sample.eyes[1], confidence)};
}

}  // namespace

glm::dquat turn_to(const glm::dvec3& direction) {
    const double level = std::sqrt(direction.x * direction.x + direction.z * direction.z);
    const Turn yaw =
        level > 0.0 ? half_of({.cos = -direction.z / level, .sin = -direction.x / level}) : Turn{};
    const Turn pitch = half_of({.cos = level, .sin = direction.y});
    return {yaw.cos * pitch.cos, yaw.cos * pitch.sin, yaw.sin * pitch.cos, -yaw.sin * pitch.sin};
}

GazeHistory::GazeHistory(const HistoryPolicy& policy)
    : policy_(policy), motion_(policy.motion), ring_(kMost) {}

void GazeHistory::add(const gaze::GazeSample& sample) {
    SeenGaze& seen = ring_[count_ % kMost];
    seen.sample = sample;
    seen.time_ns = sample.sampled.known() ? sample.sampled.ns : sample.arrived.ns;
    seen.in_head.reset();
    seen.nominal = false;
    seen.event = gaze::EyeEvent::Lost;
    ++count_;
    const auto any = [](const auto& eyes) { return eyes[0].has_value() || eyes[1].has_value(); };
    gaze::PerEye<std::optional<glm::dvec3>> eyes;
    if (!sample.tracker_gone) {
        eyes = directions_of(sample, policy_.minimum_confidence);
        seen.nominal = any(eyes);
        if (!seen.nominal) {
            eyes = directions_of(sample, 0.0);
        }
    }
    if (!any(eyes)) {
        if (policy_.motion.is_on()) {
            motion_.lose(seen.time_ns);
        }
        cyclopean_.add({});
        return;
    }
    if (policy_.motion.is_on()) {
        motion_.add(seen.time_ns, eyes, std::nullopt);
    }
    if (const auto middle = cyclopean_.add(eyes)) {
        seen.in_head = gaze::Pose{turn_to(*middle), origin_of(sample)};
        seen.event = policy_.motion.is_on() ? motion_.event() : gaze::EyeEvent::Lost;
    } else {
        seen.nominal = false;  // the eyes look in opposite directions
    }
}

std::uint64_t GazeHistory::nearest(std::int64_t time_ns) const {
    std::uint64_t after = count_ - 1;
    for (std::uint64_t number = count_; number-- > first();) {
        if ((*this)[number].time_ns <= time_ns) {
            const bool later = apart_ns((*this)[after].time_ns, time_ns) <
                               apart_ns(time_ns, (*this)[number].time_ns);
            return later && (*this)[after].time_ns >= time_ns ? after : number;
        }
        after = number;
    }
    return first();
}

std::optional<glm::dvec3> GazeHistory::turning_at(std::uint64_t number) const {
    if (number == first()) {
        return std::nullopt;
    }
    const SeenGaze& seen = (*this)[number];
    const SeenGaze& before = (*this)[number - 1];
    const std::int64_t step_ns = apart_ns(seen.time_ns, before.time_ns);
    if (!seen.in_head || !before.in_head || step_ns <= 0 || step_ns > kLongestStep_ns) {
        return std::nullopt;
    }
    const glm::dvec3 from = before.in_head->orientation * gaze::kStraightAhead;
    const glm::dvec3 to = seen.in_head->orientation * gaze::kStraightAhead;
    const auto axis = gaze::unit(glm::cross(from, to));
    const double rate = gaze::angle_between(from, to) / (static_cast<double>(step_ns) * 1e-9);
    return axis ? rate * *axis : glm::dvec3{0.0};
}

GazeAt GazeHistory::at(std::int64_t time_ns, std::int64_t now_ns) const {
    if (count_ == 0) {
        return {};
    }
    std::uint64_t number = nearest(time_ns);
    const SeenGaze& asked = (*this)[number];
    const SeenGaze& newest = (*this)[count_ - 1];
    const std::int64_t silent_ns =
        apart_ns(now_ns, newest.sample.arrived.known() ? newest.sample.arrived.ns : newest.time_ns);
    if (apart_ns(asked.time_ns, time_ns) > policy_.stale_ns || asked.sample.tracker_gone ||
        (number == count_ - 1 &&
         silent_ns > time::saturated(static_cast<__int128>(policy_.stale_ns) + policy_.hold_ns))) {
        return {};
    }
    while (!(*this)[number].in_head) {
        if (number == first() || (*this)[number].sample.tracker_gone ||
            apart_ns(asked.time_ns, (*this)[number - 1].time_ns) > policy_.hold_ns) {
            return {};
        }
        --number;
    }
    const SeenGaze& seen = (*this)[number];
    const bool held = &seen != &asked || (number == count_ - 1 && silent_ns > policy_.stale_ns);
    GazeAt at{.seen = &seen, .nominal = seen.nominal && !held, .turning = std::nullopt};
    if (!held) {
        at.turning = turning_at(number);
    }
    return at;
}

}  // namespace gazeloop::openxr_layer
