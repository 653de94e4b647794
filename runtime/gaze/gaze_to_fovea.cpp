#include "runtime/gaze/gaze_to_fovea.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/gaze/direction.h"
#include "runtime/gaze/origin_change.h"
#include "runtime/gaze/usable_pose.h"
#include "runtime/time/span.h"

namespace gazeloop::gaze {
namespace {

/// When a sample counts as seen; unknown if neither is known.
time::Stamp seen_at(const time::Stamp& sampled, const time::Stamp& arrived) {
    return sampled.known() ? sampled : arrived;
}

}  // namespace

GazeToFovea::GazeToFovea(const FoveaPolicy& policy) : policy_(policy), loss_(policy.loss) {
    if (policy.motion.is_on() || (policy.uncertainty && policy.uncertainty->by_events)) {
        motion_.emplace(policy.motion);
    }
}

void GazeToFovea::add(const GazeSample& sample) {
    const std::optional<JudgedSample> judged = loss_.add(sample);
    if (!judged) {
        return;
    }
    if (!judged->usable) {
        const time::Stamp lost = seen_at(sample.sampled, sample.arrived);
        if (motion_ && lost.known()) {
            motion_->lose(lost.ns);
        }
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
    const time::Stamp seen = seen_at(sample.sampled, sample.arrived);
    PerEye<std::optional<glm::dvec3>> directions = judged->directions;
    if (motion_ && seen.known()) {
        motion_->add(seen.ns, directions, valid.head);
    }
    for (const Eye eye : kEyes) {
        const std::size_t i = index(eye);
        const Eye whose = directions[i] ? eye : other(eye);
        valid.borrowed_for[i] = judged->causes[i];
        valid.direction_in_head[i] = *directions[index(whose)];
        valid.covariance[i] = sample.eyes[index(whose)].covariance;
        if (motion_ && seen.known() && policy_.motion.filter != GazeFilter::None) {
            valid.filter_delay_ns[i] = motion_->filter_delay_ns(whose);
        }
    }
    last_valid_ = valid;
}

void GazeToFovea::move_origin(const Pose& new_in_old) {
    if (motion_) {
        motion_->turn_world(glm::conjugate(new_in_old.orientation));
    }
    if (last_valid_ && last_valid_->head) {
        last_valid_->head = carried(new_in_old, *last_valid_->head);
    }
}

/// Only of what is fresh: held gaze goes nowhere.
std::optional<GazePrediction> GazeToFovea::predict(const LossCondition& condition,
                                                   const time::Stamp& display) const {
    if (!policy_.motion.predict || condition.state != FoveaState::Tracking || !display.known() ||
        !seen_at(last_valid_->sampled, last_valid_->arrived).known()) {
        return std::nullopt;
    }
    return motion_->predict(display.ns);
}

FoveaPoint GazeToFovea::fovea_of(std::size_t eye, const LossCondition& condition, const Pose& head,
                                 const EyeView& view,
                                 const std::optional<GazePrediction>& prediction) const {
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
        if (motion_ && policy_.motion.is_on()) {
            point.event = motion_->event();
        }
        if (condition.state != FoveaState::Ahead) {
            point.filter_delay_ns = valid.filter_delay_ns[eye];
        }
        if (prediction) {
            const bool held_back = prediction->verdict == PredictionVerdict::DoNotExtrapolate;
            point.horizon_ns = held_back ? 0 : prediction->horizon_ns;
            point.uncertainty_rad = prediction->uncertainty_rad;
        }
        if (condition.state == FoveaState::Tracking && valid.borrowed_for[eye] != LossCause::None) {
            point.state = FoveaState::OtherEye;
            point.cause = valid.borrowed_for[eye];
        }
        if (condition.state != FoveaState::Ahead) {
            // In the frame of the head now, so that large world positions cost no precision.
            const glm::dvec3 looked = prediction ? prediction->turn * valid.direction_in_head[eye]
                                                 : valid.direction_in_head[eye];
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

double GazeToFovea::widening_of(std::size_t eye, const LossCondition& condition,
                                const time::Stamp& shown,
                                const std::optional<GazePrediction>& prediction) const {
    KnownGaze known{.state = condition.state};
    if (last_valid_) {
        const ValidSample& valid = *last_valid_;
        known.covariance = valid.covariance[eye];
        known.parallax_rad = valid.parallax_rad;
        known.head_known = valid.head.has_value();
        const time::Stamp seen = seen_at(valid.sampled, valid.arrived);
        if (seen.known()) {
            known.age_ns = time::saturated(static_cast<__int128>(time::between(seen, shown).ns) +
                                           valid.filter_delay_ns[eye].value_or(0));
        }
    }
    if (prediction && prediction->uncertainty_rad) {
        known.predicted = {.uncertainty_rad = *prediction->uncertainty_rad,
                           .horizon_ns = prediction->horizon_ns};
    }
    if (policy_.uncertainty->by_events && motion_) {
        known.motion = motion_->seen();
    }
    return uncertainty_rad(*policy_.uncertainty, known);
}

FrameFovea GazeToFovea::latch(time::Stamp latched, const Pose& head, const StereoView& views,
                              time::Stamp display) const {
    const LossCondition condition = loss_.condition(latched.ns);
    const std::optional<GazePrediction> prediction = predict(condition, display);
    FrameFovea frame;
    frame.latched = latched;
    for (const Eye eye : kEyes) {
        FoveaPoint& point = frame.eyes[index(eye)];
        point = fovea_of(index(eye), condition, head, views[index(eye)], prediction);
        if (policy_.uncertainty) {
            point.widens = true;
            point.uncertainty_rad =
                widening_of(index(eye), condition, display.known() ? display : latched, prediction);
        }
    }
    return frame;
}

}  // namespace gazeloop::gaze
