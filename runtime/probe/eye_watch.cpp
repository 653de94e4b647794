#include "runtime/probe/eye_watch.h"

#include "runtime/gaze/usable_direction.h"

namespace gazeloop::probe {

void EyeWatch::add(const gaze::GazeSample& sample) {
    for (const gaze::Eye which : gaze::kEyes) {
        const std::size_t e = gaze::index(which);
        Eye& eye = eyes_[e];
        const bool usable = gaze::usable_direction(sample.eyes[e], minimum_confidence_).has_value();
        if (usable != eye.usable) {
            eye.usable = usable;
            eye.since = {};
            eye.since.sample = sample.sequence;
            eye.since.sampled = sample.sampled;
            eye.since.arrived = sample.arrived;
        }
    }
}

bool EyeWatch::turns_at(const gaze::FrameFovea& fovea) {
    bool lost = false;
    for (const gaze::Eye which : gaze::kEyes) {
        const std::size_t e = gaze::index(which);
        Eye& eye = eyes_[e];
        const bool tracked = fovea.eyes[e].state == gaze::FoveaState::Tracking;
        eye.watched = eye.watched || tracked;
        eye.reason = gaze::LossReason::None;
        if (!eye.watched || tracked) {
            continue;
        }
        lost = true;
        // That the other eye's gaze is used is no reason to itself: this one's is invalid.
        const bool silent = fovea.eyes[e].reason == gaze::LossReason::Stale;
        eye.reason = silent ? gaze::LossReason::Stale : gaze::LossReason::Invalid;
        if (silent && eye.usable) {
            eye.usable = false;
            eye.since = {};
        }
    }
    const bool turns = lost != lost_;
    lost_ = lost;
    return turns;
}

const EyeWatch::Eye& EyeWatch::turned() const {
    const auto& [left, right] = eyes_;
    if (lost_) {
        return left.reason != gaze::LossReason::None ? left : right;
    }
    // Both are back only with the later one.
    const bool right_later =
        right.watched && (!left.watched || right.since.sample > left.since.sample);
    return right_later ? right : left;
}

Flip EyeWatch::turn() const {
    const Eye& eye = turned();
    Flip flip = eye.since;
    flip.lost = lost_;
    flip.reason = eye.reason;
    return flip;
}

}  // namespace gazeloop::probe
