#include "runtime/gaze/gaze_to_fovea.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/gaze/direction.h"
#include "runtime/gaze/origin_change.h"
#include "runtime/gaze/usable_pose.h"
#include "runtime/time/span.h"

namespace gazeloop::gaze {

GazeToFovea::GazeToFovea(const FoveaPolicy& policy) : policy_(policy), loss_(policy.loss) {}

void GazeToFovea::add(const GazeSample& sample) {
    const std::optional<JudgedSample> judged = loss_.add(sample);
    if (!judged || !judged->usable) {
        return;
    }
    ValidSample valid{.direction_in_head = {},
                      .parallax_rad = sample.parallax_rad,
                      .head = usable_pose(sample.head),
                      .sequence = sample.sequence,
                      .sampled = sample.sampled,
                      .arrived = sample.arrived,
                      .ready = sample.ready,
                      .uncertainty_ns = sample.uncertainty_ns};
    for (const Eye eye : kEyes) {
        const std::size_t i = index(eye);
        valid.borrowed_for[i] = judged->causes[i];
        valid.direction_in_head[i] =
            judged->directions[i] ? *judged->directions[i] : *judged->directions[index(other(eye))];
        valid.covariance[i] = sample.eyes[judged->directions[i] ? i : index(other(eye))].covariance;
    }
    last_valid_ = valid;
}

void GazeToFovea::move_origin(const Pose& new_in_old) {
    if (last_valid_ && last_valid_->head) {
        last_valid_->head = carried(new_in_old, *last_valid_->head);
    }
}

FoveaPoint GazeToFovea::fovea_of(std::size_t eye, const LossCondition& condition, const Pose& head,
                                 const EyeView& view) const {
    const Pose world_in_head = inverse(head);
    const Pose view_in_head = compose(world_in_head, view.pose);
    const glm::dquat head_to_view = glm::conjugate(view_in_head.orientation);
    const glm::dvec3 ahead = unit(head_to_view * kStraightAhead).value_or(kStraightAhead);

    FoveaPoint point;
    point.state = condition.state;
    point.reason = condition.reason;
    point.cause = condition.cause;
    point.direction = ahead;
    if (last_valid_) {
        const ValidSample& valid = *last_valid_;
        point.sample_sequence = valid.sequence;
        point.sampled = valid.sampled;
        point.arrived = valid.arrived;
        point.ready = valid.ready;
        point.uncertainty_ns = valid.uncertainty_ns;
        point.parallax_rad = valid.parallax_rad;
        if (condition.state == FoveaState::Tracking && valid.borrowed_for[eye] != LossCause::None) {
            point.state = FoveaState::OtherEye;
            point.cause = valid.borrowed_for[eye];
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

std::optional<double> GazeToFovea::uncertainty_of(std::size_t eye, const LossCondition& condition,
                                                  const time::Stamp& latched,
                                                  const time::Stamp& display) const {
    if (!policy_.uncertainty) {
        return std::nullopt;
    }
    KnownGaze known{.state = condition.state};
    if (last_valid_) {
        const ValidSample& valid = *last_valid_;
        const time::Stamp& seen = valid.sampled.known() ? valid.sampled : valid.arrived;
        const time::Stamp& shown = display.known() ? display : latched;
        known.covariance = valid.covariance[eye];
        known.parallax_rad = valid.parallax_rad;
        known.head_known = valid.head.has_value();
        if (seen.known()) {
            known.age_ns = time::between(seen, shown).ns;
        }
    }
    return uncertainty_rad(*policy_.uncertainty, known);
}

FrameFovea GazeToFovea::latch(time::Stamp latched, const Pose& head, const StereoView& views,
                              time::Stamp display) const {
    const LossCondition condition = loss_.condition(latched.ns);
    FrameFovea frame;
    frame.latched = latched;
    for (const Eye eye : kEyes) {
        FoveaPoint& point = frame.eyes[index(eye)];
        point = fovea_of(index(eye), condition, head, views[index(eye)]);
        point.uncertainty_rad = uncertainty_of(index(eye), condition, latched, display);
    }
    return frame;
}

}  // namespace gazeloop::gaze
