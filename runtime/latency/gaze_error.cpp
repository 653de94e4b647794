#include "runtime/latency/gaze_error.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "runtime/gaze/direction.h"
#include "runtime/gaze/gaze_to_fovea.h"
#include "runtime/gaze/usable_pose.h"
#include "runtime/time/span.h"

namespace gazeloop::latency {
namespace {

/// Only what the loop itself would follow by default tells where an eye looked.
std::optional<glm::dvec3> vouched_for(const gaze::EyeRay& ray) {
    constexpr double kMinimum = gaze::FoveaPolicy{}.minimum_confidence;
    const bool confident = ray.confidence == -1.0 || ray.confidence >= kMinimum;
    return ray.valid && confident ? gaze::unit(ray.direction) : std::nullopt;
}

std::optional<glm::dquat> orientation_of(const std::optional<gaze::Pose>& pose) {
    const std::optional<gaze::Pose> usable = gaze::usable_pose(pose);
    return usable ? std::optional(usable->orientation) : std::nullopt;
}

bool is_near(std::int64_t earlier_ns, std::int64_t later_ns) {
    return static_cast<__int128>(later_ns) - earlier_ns <= GazeError::kNear_ns;
}

void keep_greater(std::optional<double>& degrees, double radians) {
    degrees = std::max(degrees.value_or(0.0), glm::degrees(radians));
}

}  // namespace

const GazeError::Seen* GazeError::recent(std::size_t back) const {
    if (back >= std::min(recent_count_, kRecent)) {
        return nullptr;
    }
    return &recent_[(recent_count_ - 1 - back) % kRecent];
}

const GazeError::Seen* GazeError::find(std::uint64_t sequence, const time::Stamp& sampled) const {
    for (std::size_t back = 0; const Seen* const seen = recent(back); ++back) {
        if (seen->sequence == sequence && seen->sampled == sampled) {
            return seen;
        }
    }
    return nullptr;
}

void GazeError::add(const gaze::GazeSample& sample) {
    if (!sample.sampled.known()) {
        return;
    }
    if (time::goes_back(std::exchange(sampled_before_, sample.sampled), sample.sampled)) {
        return;
    }
    const Seen* const before = recent(0);
    Seen& seen = recent_[recent_count_++ % kRecent];
    const Seen last = before != nullptr ? *before : Seen{};
    seen = {.sequence = sample.sequence,
            .sampled = sample.sampled,
            .direction_in_head = {vouched_for(sample.eyes[0]), vouched_for(sample.eyes[1])},
            .head = orientation_of(sample.head)};
    for (std::size_t place = 0; place < count_; ++place) {
        Pending& pending = pending_[(first_ + place) % kMost];
        if (!pending.decided && pending.shown.ns <= seen.sampled.ns) {
            decide(pending, before != nullptr ? &last : nullptr, seen);
        }
    }
}

void GazeError::move_origin(const gaze::Pose& new_in_old) {
    const glm::dquat carry = glm::conjugate(new_in_old.orientation);
    for (Seen& seen : recent_) {
        seen.head = seen.head ? std::optional(carry * *seen.head) : std::nullopt;
    }
    for (std::size_t place = 0; place < count_; ++place) {
        Pending& pending = pending_[(first_ + place) % kMost];
        pending.head = carry * pending.head;
        for (std::optional<glm::dvec3>& fovea : pending.fovea) {
            fovea = fovea ? std::optional(carry * *fovea) : std::nullopt;
        }
    }
}

void GazeError::add(const frame::FrameRecord& record, const time::Stamp& shown, bool of_gaze) {
    Pending& pending = pending_[(first_ + count_++) % kMost];
    pending = {.error = {.of_gaze = of_gaze}, .shown = shown};
    const std::optional<glm::dquat> head = orientation_of(record.head);
    if (!of_gaze) {
        pending.decided = true;
    } else if (!shown.known() || !head) {
        ++gaps_.no_display_time;
        pending.decided = true;
    } else {
        pending.head = *head;
        for (const gaze::Eye eye : gaze::kEyes) {
            const std::size_t i = gaze::index(eye);
            const gaze::FoveaPoint& fovea = record.fovea.eyes[i];
            const auto view = orientation_of(record.views[i].pose);
            const auto direction = gaze::unit(fovea.direction);
            pending.fovea[i] = view && direction ? std::optional(*view * *direction) : std::nullopt;
            const Seen* const used = find(fovea.sample_sequence, fovea.sampled);
            pending.rests_on[i] = used != nullptr ? used->direction_in_head[i] : std::nullopt;
        }
        decide_by_past(pending);
    }
    if (count_ == kMost) {
        give_up(pending_[first_]);
    }
}

void GazeError::finish() {
    for (std::size_t place = 0; place < count_; ++place) {
        give_up(pending_[(first_ + place) % kMost]);
    }
}

void GazeError::give_up(Pending& pending) {
    if (!pending.decided) {
        pending.decided = true;
        ++gaps_.no_sample_near;
    }
}

/// Where samples from after the frame have come already.
void GazeError::decide_by_past(Pending& pending) {
    const Seen* after = recent(0);
    if (after == nullptr || after->sampled.ns < pending.shown.ns) {
        return;
    }
    const Seen* before = nullptr;
    for (std::size_t back = 1; (before = recent(back)) != nullptr; ++back) {
        if (before->sampled.ns <= pending.shown.ns) {
            break;
        }
        after = before;
    }
    decide(pending, before, *after);
}

void GazeError::decide(Pending& pending, const Seen* before, const Seen& after) {
    pending.decided = true;
    const std::int64_t shown_ns = pending.shown.ns;
    if (before == nullptr || before->sampled.ns > shown_ns || after.sampled.ns < shown_ns ||
        !is_near(before->sampled.ns, shown_ns) || !is_near(shown_ns, after.sampled.ns)) {
        ++gaps_.no_sample_near;
        return;
    }
    const std::int64_t length_ns = after.sampled.ns - before->sampled.ns;  // both are near
    const double fraction = length_ns == 0 ? 1.0
                                           : static_cast<double>(shown_ns - before->sampled.ns) /
                                                 static_cast<double>(length_ns);
    FrameGazeError& error = pending.error;
    const bool heads = before->head && after.head;
    bool seen = false;
    for (const gaze::Eye eye : gaze::kEyes) {
        const std::size_t i = gaze::index(eye);
        const auto& from = before->direction_in_head[i];
        const auto& to = after.direction_in_head[i];
        const std::optional<glm::dvec3>& fovea = pending.fovea[i];
        if (!from || !to || !fovea) {
            continue;
        }
        seen = true;
        if (heads) {
            const glm::dvec3 looked =
                gaze::interpolate(*before->head * *from, *after.head * *to, fraction);
            keep_greater(error.degrees, gaze::angle_between(*fovea, looked));
            if (pending.rests_on[i]) {
                keep_greater(error.without_poses_degrees,
                             gaze::angle_between(pending.head * *pending.rests_on[i], looked));
            }
        } else {
            const glm::dvec3 looked = pending.head * gaze::interpolate(*from, *to, fraction);
            keep_greater(error.without_poses_degrees, gaze::angle_between(*fovea, looked));
        }
    }
    gaps_.eye_lost += seen ? 0 : 1;
    gaps_.no_head += seen && !heads ? 1 : 0;
    error.kind =
        time::weaker(pending.shown.kind, time::weaker(before->sampled.kind, after.sampled.kind));
}

}  // namespace gazeloop::latency
