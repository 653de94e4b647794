#include "runtime/gaze/head_track.h"

#include <algorithm>
#include <cassert>
#include <glm/common.hpp>

namespace gazeloop::gaze {
namespace {

/// later - earlier, for any two times in this order (a signed difference could overflow).
double interval_ns(std::int64_t earlier, std::int64_t later) {
    return static_cast<double>(static_cast<std::uint64_t>(later) -
                               static_cast<std::uint64_t>(earlier));
}

}  // namespace

void HeadTrack::add(std::int64_t time_ns, const Pose& pose) {
    assert(poses_.empty() || poses_.back().time_ns <= time_ns);
    if (!poses_.empty() && poses_.back().time_ns == time_ns) {
        poses_.back().pose = pose;
        return;
    }
    poses_.push_back({time_ns, pose});
}

Pose HeadTrack::at(std::int64_t time_ns) const {
    assert(!poses_.empty());
    const auto after = std::upper_bound(
        poses_.begin(), poses_.end(), time_ns,
        [](std::int64_t time, const TimedPose& timed) { return time < timed.time_ns; });
    if (after == poses_.begin()) {
        return after->pose;
    }
    const auto before = after - 1;
    if (after == poses_.end() || before->time_ns == time_ns) {
        return before->pose;
    }
    const double fraction =
        interval_ns(before->time_ns, time_ns) / interval_ns(before->time_ns, after->time_ns);
    // glm::slerp takes the shorter way round and mixes linearly where the two nearly agree.
    return {glm::normalize(glm::slerp(before->pose.orientation, after->pose.orientation, fraction)),
            glm::mix(before->pose.position_m, after->pose.position_m, fraction)};
}

}  // namespace gazeloop::gaze
