#include "runtime/latency/gaze_errors.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "runtime/gaze/direction.h"
#include "runtime/gaze/gaze_to_fovea.h"
#include "runtime/gaze/usable_pose.h"
#include "runtime/time/span.h"

namespace gazeloop::latency {
namespace {

/// Only what the loop itself would follow by default tells where an eye looked.
std::optional<glm::dvec3> vouched_for(const gaze::EyeRay& ray) {
    constexpr double kMinimum = gaze::LossPolicy{}.minimum_confidence;
    const bool confident = ray.confidence == -1.0 || ray.confidence >= kMinimum;
    return ray.valid && confident ? gaze::unit(ray.direction) : std::nullopt;
}

std::optional<glm::dquat> orientation_of(const std::optional<gaze::Pose>& pose) {
    const std::optional<gaze::Pose> usable = gaze::usable_pose(pose);
    return usable ? std::optional(usable->orientation) : std::nullopt;
}

bool is_near(std::int64_t earlier_ns, std::int64_t later_ns) {
    return static_cast<__int128>(later_ns) - earlier_ns <= GazeErrors::kNear_ns;
}

void keep_greater(std::optional<double>& greatest, double radians) {
    greatest = std::max(greatest.value_or(0.0), radians);
}

bool rests_on_fresh_sample(const gaze::FrameFovea& fovea) {
    return std::ranges::all_of(fovea.eyes, [](const gaze::FoveaPoint& eye) {
        return eye.state == gaze::FoveaState::Tracking || eye.state == gaze::FoveaState::OtherEye;
    });
}

}  // namespace

const GazeErrors::Seen* GazeErrors::seen(std::size_t place) const {
    const bool kept = place < seen_count_ && seen_count_ - place <= kRecent;
    return kept ? &recent_[place % kRecent] : nullptr;
}

const GazeErrors::Seen* GazeErrors::find(std::uint64_t sequence, const time::Stamp& sampled) const {
    for (std::size_t back = 1; back <= std::min(seen_count_, kLookBack); ++back) {
        const Seen* const one = seen(seen_count_ - back);
        if (one->sequence == sequence && one->sampled == sampled) {
            return one;
        }
    }
    return nullptr;
}

void GazeErrors::add(const gaze::GazeSample& sample) {
    if (!sample.sampled.known() ||
        time::goes_back(std::exchange(sampled_before_, sample.sampled), sample.sampled)) {
        return;
    }
    recent_[seen_count_ % kRecent] = {
        .sequence = sample.sequence,
        .sampled = sample.sampled,
        .direction_in_head = {vouched_for(sample.eyes[0]), vouched_for(sample.eyes[1])},
        .head = orientation_of(sample.head)};
    const std::size_t place = seen_count_++;
    for (std::size_t waiting = 0; waiting < count_; ++waiting) {
        Pending& pending = pending_[(first_ + waiting) % kMost];
        if (!pending.decided && pending.shown.known() && pending.shown.ns <= sample.sampled.ns) {
            compare(pending, place > 0 ? seen(place - 1) : nullptr, *seen(place));
        }
    }
}

void GazeErrors::move_origin(const gaze::Pose& new_in_old) {
    const glm::dquat carry = glm::conjugate(new_in_old.orientation);
    for (Seen& one : recent_) {
        one.head = one.head ? std::optional(carry * *one.head) : std::nullopt;
    }
    for (std::size_t waiting = 0; waiting < count_; ++waiting) {
        Pending& pending = pending_[(first_ + waiting) % kMost];
        pending.head = carry * pending.head;
        for (std::optional<glm::dvec3>& fovea : pending.fovea) {
            fovea = fovea ? std::optional(carry * *fovea) : std::nullopt;
        }
    }
}

void GazeErrors::add(const frame::FrameRecord& record) {
    Pending& pending = pending_[(first_ + count_++) % kMost];
    pending = {.index = record.index,
               .of_gaze = rests_on_fresh_sample(record.fovea),
               .seen_before = seen_count_};
    pending.decided = !pending.of_gaze;
    const std::optional<glm::dquat> head = orientation_of(record.head);
    if (pending.of_gaze && !head) {
        decide(pending, frame::GazeErrorGap::NoDisplayTime);
    } else if (pending.of_gaze) {
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
    }
    if (Pending& oldest = pending_[first_]; count_ == kMost && !oldest.decided) {
        decide(oldest, frame::GazeErrorGap::NoSampleNear);
    }
}

void GazeErrors::set_shown(std::uint64_t index, const time::Stamp& shown) {
    for (std::size_t waiting = 0; waiting < count_; ++waiting) {
        Pending& pending = pending_[(first_ + waiting) % kMost];
        if (pending.index == index && !pending.decided) {
            pending.shown = shown;
            if (shown.known()) {
                decide_by_seen(pending);
            } else {
                decide(pending, frame::GazeErrorGap::NoDisplayTime);
            }
        }
    }
}

void GazeErrors::finish() {
    for (std::size_t waiting = 0; waiting < count_; ++waiting) {
        Pending& pending = pending_[(first_ + waiting) % kMost];
        if (!pending.decided) {
            decide(pending, frame::GazeErrorGap::NoSampleNear);
        }
    }
}

void GazeErrors::decide(Pending& pending, frame::GazeErrorGap gap) {
    pending.decided = true;
    pending.error.gap = gap;
}

/// Whatever became known first, the frame's end or the samples: the same two samples decide.
void GazeErrors::decide_by_seen(Pending& pending) {
    const std::int64_t shown_ns = pending.shown.ns;
    const std::size_t begin = pending.seen_before;
    const Seen* const newest = begin > 0 ? seen(begin - 1) : nullptr;
    if (newest != nullptr && newest->sampled.ns >= shown_ns) {
        const Seen* after = newest;
        for (std::size_t back = 2; back <= std::min(begin, kLookBack); ++back) {
            const Seen* const before = seen(begin - back);
            if (before == nullptr || before->sampled.ns <= shown_ns) {
                compare(pending, before, *after);
                return;
            }
            after = before;
        }
        decide(pending, frame::GazeErrorGap::NoSampleNear);
        return;
    }
    for (std::size_t place = begin; place < seen_count_; ++place) {
        const Seen* const after = seen(place);
        if (after != nullptr && after->sampled.ns >= shown_ns) {
            compare(pending, place > 0 ? seen(place - 1) : nullptr, *after);
            return;
        }
    }
}

void GazeErrors::compare(Pending& pending, const Seen* before, const Seen& after) const {
    const std::int64_t shown_ns = pending.shown.ns;
    if (before == nullptr || before->sampled.ns > shown_ns ||
        !is_near(before->sampled.ns, shown_ns) || !is_near(shown_ns, after.sampled.ns)) {
        decide(pending, frame::GazeErrorGap::NoSampleNear);
        return;
    }
    const std::int64_t length_ns = after.sampled.ns - before->sampled.ns;  // both are near
    const double fraction = length_ns == 0 ? 1.0
                                           : static_cast<double>(shown_ns - before->sampled.ns) /
                                                 static_cast<double>(length_ns);
    frame::GazeError& error = pending.error;
    const bool heads = before->head && after.head;
    for (const gaze::Eye eye : gaze::kEyes) {
        const std::size_t i = gaze::index(eye);
        const auto& from = before->direction_in_head[i];
        const auto& to = after.direction_in_head[i];
        const std::optional<glm::dvec3>& fovea = pending.fovea[i];
        if (!from || !to || !fovea) {
            continue;
        }
        if (!heads) {
            const glm::dvec3 looked = pending.head * gaze::interpolate(*from, *to, fraction);
            keep_greater(error.without_poses_radians, gaze::angle_between(*fovea, looked));
            continue;
        }
        const glm::dvec3 looked =
            gaze::interpolate(*before->head * *from, *after.head * *to, fraction);
        keep_greater(error.radians, gaze::angle_between(*fovea, looked));
        if (pending.rests_on[i]) {
            keep_greater(error.without_poses_radians,
                         gaze::angle_between(pending.head * *pending.rests_on[i], looked));
        }
    }
    const bool known = error.radians || error.without_poses_radians;
    error.kind = known ? time::weaker(pending.shown.kind,
                                      time::weaker(before->sampled.kind, after.sampled.kind))
                       : time::StampKind::Unknown;
    decide(pending, !known          ? frame::GazeErrorGap::EyeLost
                    : error.radians ? frame::GazeErrorGap::None
                                    : frame::GazeErrorGap::NoHead);
}

}  // namespace gazeloop::latency
