#include "runtime/gaze/gaze_motion.h"

#include <cmath>

namespace gazeloop::gaze {

GazeMotion::GazeMotion(const MotionPolicy& policy)
    : policy_(policy),
      predictor_(policy.longest_prediction_ns),
      filters_{Filters{OneEuroFilter(policy.one_euro), FixationFilter(policy.fixation)},
               Filters{OneEuroFilter(policy.one_euro), FixationFilter(policy.fixation)}} {}

void GazeMotion::reset_filter(std::size_t eye) {
    filters_[eye].one_euro.reset();
    filters_[eye].fixation.reset();
}

void GazeMotion::add(std::int64_t time_ns, PerEye<std::optional<glm::dvec3>>& in_head,
                     const std::optional<Pose>& head) {
    const std::optional<glm::dquat> orientation =
        head ? std::optional(head->orientation) : std::nullopt;
    const bool in_another_frame = started_ && orientation.has_value() != head_.has_value();
    started_ = true;
    head_ = orientation;
    if (in_another_frame) {
        lose(time_ns);  // its directions are no sequel to those before
        return;
    }
    const glm::dquat to_world = orientation.value_or(glm::dquat{1.0, 0.0, 0.0, 0.0});
    PerEye<std::optional<glm::dvec3>> in_world;
    for (std::size_t eye = 0; eye < kEyeCount; ++eye) {
        in_world[eye] = in_head[eye] ? unit(to_world * *in_head[eye]) : std::nullopt;
    }
    predictor_.add(time_ns, cyclopean_.add(in_world));
    for (std::size_t eye = 0; eye < kEyeCount; ++eye) {
        if (!in_world[eye]) {
            reset_filter(eye);
            continue;
        }
        switch (policy_.filter) {
            case GazeFilter::None:
                continue;
            case GazeFilter::OneEuro:
                in_world[eye] = filters_[eye].one_euro.add(time_ns, *in_world[eye]);
                break;
            case GazeFilter::Fixation:
                in_world[eye] = filters_[eye].fixation.add(time_ns, *in_world[eye], event());
                break;
        }
        in_head[eye] = unit(glm::conjugate(to_world) * *in_world[eye]);
    }
}

void GazeMotion::lose(std::int64_t time_ns) {
    predictor_.add(time_ns, cyclopean_.add({}));
    for (std::size_t eye = 0; eye < kEyeCount; ++eye) {
        reset_filter(eye);
    }
}

void GazeMotion::turn_world(const glm::dquat& rotation) {
    if (!head_) {
        return;
    }
    head_ = rotation * *head_;
    cyclopean_.turn(rotation);
    predictor_.turn(rotation);
    for (Filters& filters : filters_) {
        filters.one_euro.turn(rotation);
        filters.fixation.turn(rotation);
    }
}

std::int64_t GazeMotion::filter_delay_ns(Eye eye) const {
    const Filters& filters = filters_[index(eye)];
    switch (policy_.filter) {
        case GazeFilter::None:
            break;
        case GazeFilter::OneEuro:
            return std::llround(filters.one_euro.delay_s() * 1e9);
        case GazeFilter::Fixation:
            return std::llround(filters.fixation.delay_s() * 1e9);
    }
    return 0;
}

GazePrediction GazeMotion::predict(std::int64_t time_ns) const {
    GazePrediction prediction = predictor_.predict(time_ns);
    if (head_ && prediction.verdict == PredictionVerdict::Extrapolated) {
        prediction.turn = glm::conjugate(*head_) * prediction.turn * *head_;
    }
    return prediction;
}

}  // namespace gazeloop::gaze
