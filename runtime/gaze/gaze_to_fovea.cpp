#include "runtime/gaze/gaze_to_fovea.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "runtime/gaze/direction.h"
#include "runtime/gaze/origin_change.h"
#include "runtime/gaze/usable_direction.h"
#include "runtime/gaze/usable_pose.h"
#include "runtime/time/span.h"

namespace gazeloop::gaze {
namespace {

std::int64_t elapsed_ns(std::int64_t from, std::int64_t to) {
    std::int64_t difference = 0;
    if (__builtin_sub_overflow(to, from, &difference)) {
        return to > from ? std::numeric_limits<std::int64_t>::max()
                         : std::numeric_limits<std::int64_t>::min();
    }
    return difference;
}

std::int64_t age_ns(const time::Stamp& sampled, const time::Stamp& arrived, std::int64_t now_ns) {
    if (!sampled.known() && !arrived.known()) {
        return std::numeric_limits<std::int64_t>::max();
    }
    std::int64_t age = std::numeric_limits<std::int64_t>::min();
    for (const time::Stamp& stamp : {sampled, arrived}) {
        if (stamp.known()) {
            age = std::max(age, elapsed_ns(stamp.ns, now_ns));
        }
    }
    return age;
}

double smooth_step(double t) { return t * t * (3.0 - 2.0 * t); }

}  // namespace

GazeToFovea::GazeToFovea(const FoveaPolicy& policy) : policy_(policy) {}

void GazeToFovea::add(const GazeSample& sample) {
    const Times times{sample.sampled, sample.arrived, sample.ready, sample.uncertainty_ns};
    if (time::goes_back(std::exchange(sampled_before_, times.sampled), times.sampled)) {
        return;
    }

    newest_ = times;
    PerEye<std::optional<glm::dvec3>> seen;
    for (const Eye eye : kEyes) {
        seen[index(eye)] = usable_direction(sample.eyes[index(eye)], policy_.minimum_confidence);
    }
    newest_valid_ = seen[0] || seen[1];
    if (!newest_valid_) {
        return;
    }
    ValidSample valid{.direction_in_head = {},
                      .borrowed = {},
                      .parallax_rad = sample.parallax_rad,
                      .head = usable_pose(sample.head),
                      .sequence = sample.sequence,
                      .times = times};
    for (const Eye eye : kEyes) {
        const std::size_t i = index(eye);
        valid.borrowed[i] = !seen[i];
        valid.direction_in_head[i] = seen[i] ? *seen[i] : *seen[index(other(eye))];
    }
    last_valid_ = valid;
}

void GazeToFovea::move_origin(const Pose& new_in_old) {
    if (last_valid_ && last_valid_->head) {
        last_valid_->head = carried(new_in_old, *last_valid_->head);
    }
}

GazeToFovea::Condition GazeToFovea::condition_at(std::int64_t latched_ns) const {
    if (!last_valid_) {
        return {FoveaState::Ahead, LossReason::Never, 1.0};
    }
    const bool fresh = age_ns(newest_->sampled, newest_->arrived, latched_ns) <= policy_.stale_ns;
    if (newest_valid_ && fresh) {
        return {FoveaState::Tracking, LossReason::None, 0.0};
    }
    const LossReason reason = fresh ? LossReason::Invalid : LossReason::Stale;
    const std::int64_t age =
        age_ns(last_valid_->times.sampled, last_valid_->times.arrived, latched_ns);
    if (age <= policy_.hold_ns) {
        return {FoveaState::Held, reason, 0.0};
    }
    const std::int64_t returning = elapsed_ns(policy_.hold_ns, age);
    if (returning < policy_.return_ns) {
        return {
            FoveaState::Returning, reason,
            smooth_step(static_cast<double>(returning) / static_cast<double>(policy_.return_ns))};
    }
    return {FoveaState::Ahead, reason, 1.0};
}

FoveaPoint GazeToFovea::fovea_of(std::size_t eye, const Condition& condition, const Pose& head,
                                 const EyeView& view) const {
    const Pose world_in_head = inverse(head);
    const Pose view_in_head = compose(world_in_head, view.pose);
    const glm::dquat head_to_view = glm::conjugate(view_in_head.orientation);
    const glm::dvec3 ahead = unit(head_to_view * kStraightAhead).value_or(kStraightAhead);

    FoveaPoint point;
    point.state = condition.state;
    point.reason = condition.reason;
    point.direction = ahead;
    if (last_valid_) {
        const ValidSample& valid = *last_valid_;
        point.sample_sequence = valid.sequence;
        point.sampled = valid.times.sampled;
        point.arrived = valid.times.arrived;
        point.ready = valid.times.ready;
        point.uncertainty_ns = valid.times.uncertainty_ns;
        point.parallax_rad = valid.parallax_rad;
        if (condition.state == FoveaState::Tracking && valid.borrowed[eye]) {
            point.state = FoveaState::OtherEye;
        }
        if (condition.state != FoveaState::Ahead) {
            // In the frame of the head now, so that large world positions cost no precision.
            const glm::dvec3& looked = valid.direction_in_head[eye];
            const glm::dvec3 eye_offset_m = view_in_head.position_m;
            const Pose then_in_now = valid.head ? compose(world_in_head, *valid.head) : Pose{};
            const glm::dvec3 point_m =
                transform_point(then_in_now, eye_offset_m + policy_.fixation_distance_m * looked);
            const glm::dvec3 seen = unit(point_m - eye_offset_m).value_or(looked);
            const glm::dvec3 in_view = unit(head_to_view * seen).value_or(ahead);
            point.direction = condition.state == FoveaState::Returning
                                  ? interpolate(in_view, ahead, condition.returned)
                                  : in_view;
        }
    }
    point.position = project(point.direction, view);
    return point;
}

FrameFovea GazeToFovea::latch(time::Stamp latched, const Pose& head,
                              const StereoView& views) const {
    const Condition condition = condition_at(latched.ns);
    FrameFovea frame;
    frame.latched = latched;
    for (const Eye eye : kEyes) {
        frame.eyes[index(eye)] = fovea_of(index(eye), condition, head, views[index(eye)]);
    }
    return frame;
}

}  // namespace gazeloop::gaze
