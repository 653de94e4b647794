#include "runtime/openxr_layer/gaze_reading.h"

#include <algorithm>

#include "runtime/time/clock.h"

namespace gazeloop::openxr_layer {
namespace {

glm::dvec3 from_xr(const XrVector3f& v) { return {v.x, v.y, v.z}; }

}  // namespace

std::optional<Locating> locating(LayeredInstance& layered, XrSpace space, XrSpace base) {
    if (!layered.provides_eye_gaze()) {
        return std::nullopt;
    }
    const std::lock_guard lock(layered.mutex);
    for (auto& [handle, session] : layered.sessions) {
        const auto located = [&](XrSpace one) -> std::optional<LocatedSpace> {
            const auto found = session.gaze_spaces.find(one);
            if (found == session.gaze_spaces.end() ||
                (!found->second.eyes_alone && !layered.bindings.is_bound(found->second.action))) {
                return std::nullopt;
            }
            return LocatedSpace{
                found->second,
                std::ranges::find(session.active, found->second.action) != session.active.end() &&
                    layered.permits_gaze()};
        };
        const auto found = located(space);
        const auto found_base = located(base);
        if (!found && !found_base) {
            continue;
        }
        return Locating{.session = handle,
                        .view_space = session.view_space,
                        .feed = session.feed,
                        .times = layered.times,
                        .space = found,
                        .base = found_base};
    }
    return std::nullopt;
}

std::optional<GivenGaze> gaze_at(const Locating& locating, XrTime time, SeenGaze* sample) {
    if (locating.feed == nullptr) {
        return std::nullopt;
    }
    const std::int64_t now_ns = time::monotonic_ns();
    const std::int64_t asked_ns = locating.times.host_ns(time).value_or(now_ns);
    auto given =
        locating.feed->take(now_ns, [&](const GazeHistory& history) -> std::optional<GivenGaze> {
            const GazeAt at = history.at(asked_ns, now_ns);
            if (at.seen == nullptr) {
                return std::nullopt;
            }
            if (sample != nullptr) {
                *sample = *at.seen;
            }
            return GivenGaze{.in_head = {.pose = *at.seen->in_head, .turning = at.turning},
                             .nominal = at.nominal,
                             .time_ns = at.seen->time_ns,
                             .time_known = at.seen->sample.sampled.known(),
                             .time = 0};
        });
    if (given) {
        given->time = locating.times.xr_time(given->time_ns).value_or(0);
    }
    return given;
}

HeadLocated head_in(const NextFunctions& next, XrSpace view_space, XrSpace base, XrTime time,
                    XrTime otherwise) {
    XrSpaceVelocity velocity{};
    velocity.type = XR_TYPE_SPACE_VELOCITY;
    XrSpaceLocation location{};
    location.type = XR_TYPE_SPACE_LOCATION;
    location.next = &velocity;
    HeadLocated located;
    located.result =
        time > 0 ? next.LocateSpace(view_space, base, time, &location) : XR_ERROR_TIME_INVALID;
    if (located.result == XR_ERROR_TIME_INVALID && otherwise != time) {
        located.result = next.LocateSpace(view_space, base, otherwise, &location);
    }
    if (XR_FAILED(located.result)) {
        return located;
    }
    const bool has_position = (location.locationFlags & XR_SPACE_LOCATION_POSITION_VALID_BIT) != 0;
    if (!has_position) {
        location.pose.position = {};
    }
    const auto pose = openxr::from_xr(location.pose);
    if (!pose || (location.locationFlags & XR_SPACE_LOCATION_ORIENTATION_VALID_BIT) == 0) {
        return located;
    }
    located.valid = true;
    located.position_valid = has_position;
    located.head.pose = *pose;
    if ((velocity.velocityFlags & XR_SPACE_VELOCITY_ANGULAR_VALID_BIT) != 0) {
        located.head.angular = from_xr(velocity.angularVelocity);
    }
    if ((velocity.velocityFlags & XR_SPACE_VELOCITY_LINEAR_VALID_BIT) != 0) {
        located.head.linear = from_xr(velocity.linearVelocity);
    }
    return located;
}

void note_gaze_read(LayeredInstance& layered, XrSession session) {
    const std::lock_guard lock(layered.mutex);
    LayeredSession* const known = layered.session(session);
    if (known == nullptr) {
        return;
    }
    const std::int64_t now_ns = time::monotonic_ns();
    layered.note_gaze_read(*known, now_ns);
    if (known->tap == nullptr) {
        return;
    }
    if (known->feed != nullptr) {
        known->feed->look(
            [&](const GazeHistory& history) { tell_samples(layered, *known, history); });
    }
    known->tap->read_gaze(now_ns);
}

void tell_samples(const LayeredInstance& layered, const LayeredSession& session,
                  const GazeHistory& history) {
    session.tap->take(history, [&](std::int64_t time_ns) -> std::optional<gaze::Pose> {
        const auto time = layered.times.xr_time(time_ns);
        if (session.views_in == XR_NULL_HANDLE || !time) {
            return std::nullopt;
        }
        const HeadLocated head =
            head_in(layered.next, session.view_space, session.views_in, *time, *time);
        return head.valid && head.position_valid ? std::optional(head.head.pose) : std::nullopt;
    });
}

}  // namespace gazeloop::openxr_layer
