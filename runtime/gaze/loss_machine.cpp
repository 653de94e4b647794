#include "runtime/gaze/loss_machine.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "runtime/gaze/direction.h"
#include "runtime/gaze/usable_direction.h"
#include "runtime/time/span.h"

namespace gazeloop::gaze {
namespace {

double smooth_step(double t) { return t * t * (3.0 - 2.0 * t); }

}  // namespace

std::int64_t LossMachine::age_ns(const Times& times, std::int64_t now_ns) {
    if (!times.sampled.known() && !times.arrived.known()) {
        return std::numeric_limits<std::int64_t>::max();
    }
    std::int64_t age = std::numeric_limits<std::int64_t>::min();
    for (const time::Stamp& stamp : {times.sampled, times.arrived}) {
        if (stamp.known()) {
            age = std::max(age, time::elapsed_ns(stamp.ns, now_ns));
        }
    }
    return age;
}

LossCause LossMachine::why_unusable(const EyeRay& ray) const {
    // Unknown openness is -1, and not-a-number is no statement either.
    if (ray.openness >= 0.0 && ray.openness < policy_.closed_below) {
        return LossCause::Blink;
    }
    const auto direction = usable_direction(ray, policy_.minimum_confidence);
    if (direction) {
        return angle_between(*direction, kStraightAhead) > policy_.field_rad
                   ? LossCause::OutsideField
                   : LossCause::None;
    }
    const bool would_do = ray.valid && unit(ray.direction).has_value();
    return would_do ? LossCause::LowConfidence : LossCause::NotSeen;
}

std::optional<JudgedSample> LossMachine::add(const GazeSample& sample) {
    went_back_ = time::goes_back(std::exchange(sampled_before_, sample.sampled), sample.sampled);
    if (went_back_) {
        return std::nullopt;
    }
    const Times now{sample.sampled, sample.arrived};
    newest_ = now;
    JudgedSample judged;
    for (const Eye eye : kEyes) {
        const std::size_t i = index(eye);
        judged.causes[i] = why_unusable(sample.eyes[i]);
        if (judged.causes[i] == LossCause::None) {
            judged.directions[i] = unit(sample.eyes[i].direction);
        }
    }
    move(judged, sample.tracker_gone, now);
    judged.usable = presence_ == GazePresence::Seen;
    if (judged.usable) {
        last_usable_ = now;
    }
    return judged;
}

bool LossMachine::still_opening(const Times& now) {
    const time::Stamp& stamp = now.sampled.known() ? now.sampled : now.arrived;
    if (policy_.reopen_ns == 0 || !stamp.known()) {
        return false;
    }
    opened_ns_ = opened_ns_.value_or(stamp.ns);
    return time::elapsed_ns(*opened_ns_, stamp.ns) < policy_.reopen_ns;
}

void LossMachine::move(const JudgedSample& judged, bool gone, const Times& now) {
    const auto& [left, right] = judged.causes;
    const bool seen = left == LossCause::None || right == LossCause::None;
    const bool shut = left == LossCause::Blink || right == LossCause::Blink;
    const bool in_blink = presence_ == GazePresence::Shut || presence_ == GazePresence::Opening;
    if (seen) {
        if (in_blink && still_opening(now)) {
            presence_ = GazePresence::Opening;
            return;
        }
        presence_ = GazePresence::Seen;
        cause_ = LossCause::None;
        opened_ns_.reset();
        return;
    }
    if (presence_ == GazePresence::Never) {
        return;
    }
    opened_ns_.reset();
    if (gone) {
        presence_ = GazePresence::Lost;
        cause_ = LossCause::Unplugged;
    } else if (shut || in_blink) {
        presence_ = GazePresence::Shut;
        cause_ = LossCause::Blink;
    } else {
        presence_ = GazePresence::Lost;
        // Where the eyes differ, what is known of one says more than that the other is not seen.
        cause_ = left == LossCause::NotSeen ? right : left;
    }
}

std::int64_t LossMachine::hold_ns(LossCause cause) const {
    switch (cause) {
        case LossCause::Blink:
            return policy_.blink_hold_ns;
        case LossCause::Unplugged:
            return policy_.unplugged_hold_ns;
        default:
            return policy_.hold_ns;
    }
}

LossCondition LossMachine::condition(std::int64_t latched_ns) const {
    if (!last_usable_) {
        return {};
    }
    const bool fresh = age_ns(*newest_, latched_ns) <= policy_.stale_ns;
    if (presence_ == GazePresence::Seen && fresh) {
        return {FoveaState::Tracking, LossReason::None, LossCause::None, 0.0};
    }
    const LossReason reason = fresh ? LossReason::Invalid : LossReason::Stale;
    const LossCause cause = presence_ != GazePresence::Seen ? cause_
                            : went_back_                    ? LossCause::ClockStep
                                                            : LossCause::Stopped;
    const std::int64_t hold = hold_ns(cause);
    const std::int64_t age = age_ns(*last_usable_, latched_ns);
    if (age <= hold || policy_.hold_for_ever) {
        return {FoveaState::Held, reason, cause, 0.0};
    }
    const std::int64_t returning = time::elapsed_ns(hold, age);
    if (returning < policy_.return_ns) {
        return {
            FoveaState::Returning, reason, cause,
            smooth_step(static_cast<double>(returning) / static_cast<double>(policy_.return_ns))};
    }
    return {FoveaState::Ahead, reason, cause, 1.0};
}

}  // namespace gazeloop::gaze
