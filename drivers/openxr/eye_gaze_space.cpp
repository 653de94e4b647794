#include "drivers/openxr/eye_gaze_space.h"

#include <array>

namespace gazeloop::drivers {

using openxr::typed;
using openxr::xr_check;
using openxr::xr_check_session;

EyeGazeSpace::EyeGazeSpace(openxr::Session& session, const EyeGazeAction& action)
    : session_(session), action_(action) {
    session.add_actions(action.set());
    session.attach_actions();
    auto info = typed<XrActionSpaceCreateInfo>(XR_TYPE_ACTION_SPACE_CREATE_INFO);
    info.action = action.action();
    info.poseInActionSpace = openxr::to_xr({});
    xr_check(xrCreateActionSpace(session.handle(), &info, &space_), "xrCreateActionSpace");
}

EyeGazeSpace::~EyeGazeSpace() {
    if (space_ != XR_NULL_HANDLE) {
        xrDestroySpace(space_);
    }
}

bool EyeGazeSpace::sync() const { return session_.sync_actions(); }

XrPath EyeGazeSpace::bound_profile() const {
    auto profile = typed<XrInteractionProfileState>(XR_TYPE_INTERACTION_PROFILE_STATE);
    xr_check_session(xrGetCurrentInteractionProfile(session_.handle(), action_.user(), &profile),
                     "xrGetCurrentInteractionProfile");
    return profile.interactionProfile;
}

bool EyeGazeSpace::active() const {
    auto get = typed<XrActionStateGetInfo>(XR_TYPE_ACTION_STATE_GET_INFO);
    get.action = action_.action();
    auto state = typed<XrActionStatePose>(XR_TYPE_ACTION_STATE_POSE);
    xr_check_session(xrGetActionStatePose(session_.handle(), &get, &state), "xrGetActionStatePose");
    return state.isActive == XR_TRUE;
}

std::optional<LocatedGaze> EyeGazeSpace::locate(XrTime time) const {
    auto sample = typed<XrEyeGazeSampleTimeEXT>(XR_TYPE_EYE_GAZE_SAMPLE_TIME_EXT);
    auto location = typed<XrSpaceLocation>(XR_TYPE_SPACE_LOCATION);
    location.next = &sample;
    const XrResult result = xrLocateSpace(space_, session_.view_space(), time, &location);
    if (result == XR_ERROR_TIME_INVALID) {
        return std::nullopt;
    }
    xr_check_session(result, "xrLocateSpace");
    LocatedGaze located{
        .pose = {},
        .valid = (location.locationFlags & XR_SPACE_LOCATION_ORIENTATION_VALID_BIT) != 0,
        .tracked = (location.locationFlags & XR_SPACE_LOCATION_POSITION_TRACKED_BIT) != 0,
        .time = sample.time};
    if ((location.locationFlags & XR_SPACE_LOCATION_POSITION_VALID_BIT) == 0) {
        location.pose.position = {};
    }
    if (located.valid) {
        located.pose = openxr::from_xr(location.pose);
    }
    return located;
}

std::optional<gaze::PerEye<glm::dvec3>> EyeGazeSpace::eyes_m(XrTime time) const {
    auto info = typed<XrViewLocateInfo>(XR_TYPE_VIEW_LOCATE_INFO);
    info.viewConfigurationType = openxr::kStereo;
    info.displayTime = time;
    info.space = session_.view_space();
    auto state = typed<XrViewState>(XR_TYPE_VIEW_STATE);
    gaze::PerEye<XrView> views{typed<XrView>(XR_TYPE_VIEW), typed<XrView>(XR_TYPE_VIEW)};
    std::uint32_t count = 0;
    const XrResult result =
        xrLocateViews(session_.handle(), &info, &state, gaze::kEyeCount, &count, views.data());
    if (result == XR_ERROR_TIME_INVALID) {
        return std::nullopt;
    }
    xr_check_session(result, "xrLocateViews");
    if (count != gaze::kEyeCount ||
        (state.viewStateFlags & XR_VIEW_STATE_POSITION_VALID_BIT) == 0) {
        return std::nullopt;
    }
    gaze::PerEye<glm::dvec3> eyes_m;
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        const auto pose = openxr::from_xr(views[e].pose);
        if (!pose) {
            return std::nullopt;
        }
        eyes_m[e] = pose->position_m;
    }
    return eyes_m;
}

}  // namespace gazeloop::drivers
