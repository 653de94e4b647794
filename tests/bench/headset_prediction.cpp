#include "tests/bench/headset_prediction.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <optional>

#include "runtime/gaze/direction.h"
#include "runtime/gaze/gaze_motion.h"
#include "runtime/gaze/usable_direction.h"
#include "runtime/gaze/usable_pose.h"

namespace gazeloop::bench {
namespace {

constexpr std::int64_t kLatest_ns = 12'000'000;

/// A sample of which all is known.
struct Seen {
    std::int64_t time_ns = 0;
    glm::dvec3 in_head{0.0};
    glm::dquat head{};
    gaze::EyeEvent event = gaze::EyeEvent::Lost;
    glm::dvec3 predicted_in_head{0.0};
};

gaze::PerEye<std::optional<glm::dvec3>> directions_of(const gaze::GazeSample& sample) {
    gaze::PerEye<std::optional<glm::dvec3>> directions;
    for (const gaze::Eye eye : gaze::kEyes) {
        directions[gaze::index(eye)] = gaze::usable_direction(sample.eyes[gaze::index(eye)], 0.0);
    }
    return directions;
}

std::vector<std::optional<Seen>> watch(const gaze::GazeTrace& trace, std::int64_t ahead_ns) {
    gaze::GazeMotion motion({.predict = true});
    std::vector<std::optional<Seen>> all;
    for (const gaze::GazeSample& sample : trace.samples) {
        auto directions = directions_of(sample);
        const std::optional<gaze::Pose> head = gaze::usable_pose(sample.head);
        const bool both = directions[0] && directions[1];
        if (!directions[0] && !directions[1]) {
            motion.lose(sample.sampled.ns);
        } else {
            motion.add(sample.sampled.ns, directions, head);
        }
        auto& seen = all.emplace_back();
        if (both && head) {
            const auto middle = gaze::unit(*directions[0] + *directions[1]);
            const glm::dquat turn = motion.predict(sample.sampled.ns + ahead_ns).turn;
            if (middle) {
                seen = Seen{sample.sampled.ns, *middle, head->orientation, motion.event(),
                            turn * *middle};
            }
        }
    }
    return all;
}

}  // namespace

std::array<HeadsetErrors, gaze::kEyeEventNames.size()> headset_errors(const gaze::GazeTrace& trace,
                                                                      std::int64_t ahead_ns) {
    std::array<HeadsetErrors, gaze::kEyeEventNames.size()> errors;
    const std::vector<std::optional<Seen>> all = watch(trace, ahead_ns);
    std::size_t to = 0;
    for (const std::optional<Seen>& from : all) {
        if (!from) {
            continue;
        }
        const std::int64_t then_ns = from->time_ns + ahead_ns;
        while (to < all.size() && trace.samples[to].sampled.ns < then_ns) {
            ++to;
        }
        if (to == all.size()) {
            break;
        }
        const std::optional<Seen>& then = all[to];
        if (!then || then->time_ns > then_ns + kLatest_ns) {
            continue;
        }
        const glm::dvec3 truth = then->head * then->in_head;
        HeadsetErrors& kind = errors[static_cast<std::size_t>(then->event) - 1];
        kind.held_in_head.push_back(
            glm::degrees(gaze::angle_between(then->head * from->in_head, truth)));
        kind.held_in_world.push_back(
            glm::degrees(gaze::angle_between(from->head * from->in_head, truth)));
        kind.predicted.push_back(
            glm::degrees(gaze::angle_between(from->head * from->predicted_in_head, truth)));
    }
    return errors;
}

}  // namespace gazeloop::bench
