// Spaces that follow the gaze. They are the runtime's own action spaces of an action that it knows
// no source of; only where they are is the layer's to say.
#include <algorithm>
#include <array>

#include "runtime/openxr_layer/gaze_reading.h"
#include "runtime/openxr_layer/gazeloop_gaze_sample.h"
#include "runtime/time/clock.h"

namespace gazeloop::openxr_layer {
namespace {

using Next = NextFunctions;

constexpr XrSpaceLocationFlags kValid =
    XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT;

XrVector3f to_xr(const glm::dvec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Where a space is, without the memory that an application wants it in.
struct Place {
    XrSpaceLocationFlags flags = 0;
    Moving moving;
    std::optional<GivenGaze> gaze;
    std::optional<SeenGaze> sample{};  ///< the gaze's, where it was wanted
};

/// Orientation and position of a gaze are tracked together; a sub-nominal one has no
/// POSITION_TRACKED.
XrSpaceLocationFlags flags_of(const GivenGaze& gaze, bool position_valid) {
    XrSpaceLocationFlags flags =
        XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT;
    if (position_valid) {
        flags |= XR_SPACE_LOCATION_POSITION_VALID_BIT;
        flags |= gaze.nominal ? XR_SPACE_LOCATION_POSITION_TRACKED_BIT : 0;
    }
    return flags;
}

/// Everything is located at the gaze's own time, so that the pose is where the eye looked then; the
/// time is told beside it.
XrResult place(const NextFunctions& next, const Locating& locating, XrSpace space, XrSpace base,
               XrTime time, Place& placed) {
    const bool ours = !locating.space || locating.space->gives_gaze;
    const bool bases = !locating.base || locating.base->gives_gaze;
    const auto gaze = ours && bases
                          ? gaze_at(locating, time, placed.sample ? &*placed.sample : nullptr)
                          : std::nullopt;
    if (!gaze) {
        return XR_SUCCESS;
    }
    if (locating.space && locating.base) {
        placed.moving.pose = gaze::compose(gaze::inverse(locating.base->space.pose_in_gaze),
                                           locating.space->space.pose_in_gaze);
        placed.moving.linear = glm::dvec3{0.0};
        placed.moving.angular = glm::dvec3{0.0};
        placed.flags = flags_of(*gaze, true);
        placed.gaze = gaze;
        return XR_SUCCESS;
    }
    const HeadLocated head =
        head_in(next, locating.view_space, locating.space ? base : space, gaze->time, time);
    if (XR_FAILED(head.result)) {
        return head.result;
    }
    if (!head.valid) {
        return XR_SUCCESS;
    }
    const gaze::Pose& fixed = (locating.space ? locating.space : locating.base)->space.pose_in_gaze;
    placed.moving = place_gaze(head.head, gaze->in_head, fixed);
    if (!locating.space) {
        placed.moving = inverse(placed.moving);
    }
    placed.flags = flags_of(*gaze, head.position_valid);
    placed.gaze = gaze;
    return XR_SUCCESS;
}

XrSpaceVelocityFlags velocity_of(const Place& placed, XrVector3f& linear, XrVector3f& angular) {
    const bool valid = placed.flags != 0;
    linear = to_xr(valid ? placed.moving.linear.value_or(glm::dvec3{0.0}) : glm::dvec3{0.0});
    angular = to_xr(valid ? placed.moving.angular.value_or(glm::dvec3{0.0}) : glm::dvec3{0.0});
    return (valid && placed.moving.linear ? XR_SPACE_VELOCITY_LINEAR_VALID_BIT : 0) |
           (valid && placed.moving.angular ? XR_SPACE_VELOCITY_ANGULAR_VALID_BIT : 0);
}

void tell_sample(const Locating& locating, const Place& placed, XrGazeSampleGAZELOOP& told) {
    void* const next = told.next;
    told = {};
    told.type = XR_TYPE_GAZE_SAMPLE_GAZELOOP;
    told.next = next;
    if (!placed.gaze) {
        return;
    }
    const gaze::GazeSample& sample = placed.sample->sample;
    told.isAvailable = XR_TRUE;
    told.sampleTime = placed.gaze->time_known ? placed.gaze->time : 0;
    told.uncertainty = sample.uncertainty_ns.value_or(-1);
    told.arrivalTime =
        sample.arrived.known() ? locating.times.xr_time(sample.arrived.ns).value_or(0) : 0;
    told.sequence = sample.sequence;
    told.processing = static_cast<XrGazeProcessingGAZELOOP>(sample.processing);
    told.event = static_cast<XrGazeEventGAZELOOP>(placed.sample->event);
    for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
        const gaze::EyeRay& ray = sample.eyes[eye];
        XrGazeSampleEyeGAZELOOP& one = told.eyes[eye];
        one.isValid = ray.valid ? XR_TRUE : XR_FALSE;
        one.origin = to_xr(ray.origin_m);
        one.direction = to_xr(ray.valid ? ray.direction : gaze::kStraightAhead);
        one.openness = static_cast<float>(ray.openness);
        one.confidence = static_cast<float>(ray.confidence);
        one.hasCovariance = ray.covariance ? XR_TRUE : XR_FALSE;
        if (ray.covariance) {
            one.covariance[0] = static_cast<float>(ray.covariance->xx_rad2);
            one.covariance[1] = static_cast<float>(ray.covariance->xy_rad2);
            one.covariance[2] = static_cast<float>(ray.covariance->yy_rad2);
        }
    }
}

XrPosef pose_of(const Place& placed) {
    return placed.flags != 0 ? openxr::to_xr(placed.moving.pose) : openxr::to_xr({});
}

XrResult create_reference_space(Call<&Next::CreateReferenceSpace>& call, XrSession session,
                                const XrReferenceSpaceCreateInfo* info, XrSpace* space) {
    const XrResult result = call.down(session, info, space);
    if (XR_SUCCEEDED(result)) {
        Instances::all().add_child(*space, call.pointer(), session);
        const std::lock_guard lock(call.instance().mutex);
        LayeredSession* const known = call.instance().session(session);
        if (known != nullptr && info->referenceSpaceType == XR_REFERENCE_SPACE_TYPE_VIEW) {
            known->view_spaces.push_back(*space);
        }
    }
    return result;
}

XrResult create_action_space(Call<&Next::CreateActionSpace>& call, XrSession session,
                             const XrActionSpaceCreateInfo* info, XrSpace* space) {
    LayeredInstance& layered = call.instance();
    const bool for_eyes = layered.provides_eye_gaze() && info != nullptr &&
                          info->subactionPath == layered.eyes && layered.eyes != XR_NULL_PATH;
    XrResult result = XR_SUCCESS;
    if (for_eyes) {
        {
            const std::lock_guard lock(layered.mutex);
            if (!layered.bindings.declares_eyes(info->action)) {
                return XR_ERROR_PATH_UNSUPPORTED;
            }
        }
        XrActionSpaceCreateInfo passed_on = *info;
        passed_on.subactionPath = XR_NULL_PATH;
        const XrActionSpaceCreateInfo* const passed = &passed_on;
        result = call.down(session, passed, space);
    } else {
        result = call.down(session, info, space);
    }
    if (XR_FAILED(result)) {
        return result;
    }
    Instances::all().add_child(*space, call.pointer(), session);
    const std::lock_guard lock(layered.mutex);
    LayeredSession* const known = layered.session(session);
    const auto fixed = openxr::from_xr(info->poseInActionSpace);
    // It may be bound to the eyes later only: until then it is nobody's gaze.
    if (known != nullptr && fixed && layered.provides_eye_gaze() &&
        (for_eyes || info->subactionPath == XR_NULL_PATH)) {
        known->gaze_spaces[*space] = {
            .action = info->action, .eyes_alone = for_eyes, .pose_in_gaze = *fixed};
    }
    return result;
}

XrResult destroy_space(Call<&Next::DestroySpace>& call, XrSpace space) {
    {
        const std::lock_guard lock(call.instance().mutex);
        for (auto& [handle, session] : call.instance().sessions) {
            session.gaze_spaces.erase(space);
            std::erase(session.view_spaces, space);
            session.views_in = session.views_in == space ? XR_NULL_HANDLE : session.views_in;
        }
    }
    Instances::all().remove_child(space);
    return call.down(space);
}

XrResult locate_space(Call<&Next::LocateSpace>& call, XrSpace space, XrSpace base, XrTime time,
                      XrSpaceLocation* location) {
    LayeredInstance& layered = call.instance();
    const auto locate = locating(layered, space, base);
    // Another source may drive the action too: what the eyes do not drive is the runtime's.
    if (!locate || location == nullptr || time <= 0 || locate->view_space == XR_NULL_HANDLE) {
        return call.down(space, base, time, location);
    }
    auto* const sample =
        in_chain<XrEyeGazeSampleTimeEXT>(location->next, XR_TYPE_EYE_GAZE_SAMPLE_TIME_EXT);
    if (sample != nullptr) {
        sample->time = 0;
    }
    auto* const told = layered.tells_samples ? in_chain<XrGazeSampleGAZELOOP>(
                                                   location->next, XR_TYPE_GAZE_SAMPLE_GAZELOOP)
                                             : nullptr;
    Place placed;
    if (told != nullptr) {
        placed.sample.emplace();
    }
    if (const XrResult result = place(layered.next, *locate, space, base, time, placed);
        XR_FAILED(result)) {
        return result;
    }
    const bool has_gaze = placed.flags != 0;
    if (!has_gaze) {
        const XrResult result = call.down(space, base, time, location);
        const bool driven = (locate->space && locate->space->gives_gaze) ||
                            (locate->base && locate->base->gives_gaze);
        if (XR_FAILED(result) || !driven) {
            return result;
        }
    }
    location->locationFlags = placed.flags;
    location->pose = pose_of(placed);
    if (auto* const velocity = in_chain<XrSpaceVelocity>(location->next, XR_TYPE_SPACE_VELOCITY)) {
        velocity->velocityFlags =
            velocity_of(placed, velocity->linearVelocity, velocity->angularVelocity);
    }
    if (sample != nullptr && has_gaze && placed.gaze->time_known) {
        sample->time = placed.gaze->time;
    }
    if (told != nullptr) {
        tell_sample(*locate, placed, *told);
    }
    if (has_gaze) {
        note_gaze_read(layered, locate->session);
    }
    return XR_SUCCESS;
}

/// The runtime answers for all; then those that are the gaze's, or located in it, are put right.
template <auto Next>
XrResult locate_spaces(Call<Next>& call, XrSession session, const newer::SpacesLocateInfo* info,
                       newer::SpaceLocations* locations) {
    const XrResult result = call.down(session, info, locations);
    LayeredInstance& layered = call.instance();
    if (XR_FAILED(result) || !layered.provides_eye_gaze()) {
        return result;
    }
    auto* const velocities =
        in_chain<newer::SpaceVelocities>(locations->next, newer::kSpaceVelocities);
    for (std::uint32_t i = 0; i < info->spaceCount; ++i) {
        const XrSpace space = info->spaces[i];
        const auto locate = locating(layered, space, info->baseSpace);
        const bool driven = locate && ((locate->space && locate->space->gives_gaze) ||
                                       (locate->base && locate->base->gives_gaze));
        Place placed;
        if (!driven ||
            XR_FAILED(place(layered.next, *locate, space, info->baseSpace, info->time, placed))) {
            continue;
        }
        locations->locations[i] = {placed.flags, pose_of(placed)};
        if (velocities != nullptr) {
            newer::SpaceVelocityData& velocity = velocities->velocities[i];
            velocity.velocityFlags =
                velocity_of(placed, velocity.linearVelocity, velocity.angularVelocity);
        }
        if (placed.flags != 0) {
            note_gaze_read(layered, locate->session);
        }
    }
    return result;
}

}  // namespace

std::span<const Hook> space_hooks() {
    static const std::array kHooks{
        hook<&Next::CreateReferenceSpace, &create_reference_space>("xrCreateReferenceSpace"),
        hook<&Next::CreateActionSpace, &create_action_space>("xrCreateActionSpace"),
        hook<&Next::DestroySpace, &destroy_space>("xrDestroySpace"),
        hook<&Next::LocateSpace, &locate_space>("xrLocateSpace"),
        hook<&Next::LocateSpaces, &locate_spaces<&Next::LocateSpaces>>("xrLocateSpaces"),
        hook<&Next::LocateSpacesKHR, &locate_spaces<&Next::LocateSpacesKHR>>("xrLocateSpacesKHR"),
    };
    return kHooks;
}

}  // namespace gazeloop::openxr_layer
