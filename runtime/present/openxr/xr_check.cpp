#include "runtime/present/openxr/xr_check.h"

#include <fmt/core.h>
#include <openxr/openxr_reflection.h>

#include "runtime/error.h"

namespace gazeloop::present {

std::string_view xr_name(XrResult result) {
    switch (result) {
#define GAZELOOP_RESULT_NAME(name, value) \
    case name:                            \
        return #name;
        XR_LIST_ENUM_XrResult(GAZELOOP_RESULT_NAME)
#undef GAZELOOP_RESULT_NAME
            default : return "an unknown XrResult";
    }
}

XrResult xr_check(XrResult result, std::string_view what) {
    if (XR_SUCCEEDED(result)) {
        return result;
    }
    const bool lost = result == XR_ERROR_INSTANCE_LOST || result == XR_ERROR_SESSION_LOST ||
                      result == XR_ERROR_RUNTIME_FAILURE;
    throw SetupError(
        lost ? ExitCode::SessionLost : ExitCode::NoDevice,
        lost ? fmt::format("OpenXR: the runtime failed, or its service is gone ({}: {}); "
                           "start it and run again",
                           what, xr_name(result))
             : fmt::format("OpenXR: {}: {}", what, xr_name(result)));
}

gaze::Pose from_xr(const XrPosef& pose) {
    const glm::dquat orientation(pose.orientation.w, pose.orientation.x, pose.orientation.y,
                                 pose.orientation.z);
    return {glm::normalize(orientation), {pose.position.x, pose.position.y, pose.position.z}};
}

XrPosef to_xr(const gaze::Pose& pose) {
    const glm::quat q(pose.orientation);
    const glm::vec3 p(pose.position_m);
    return {{q.x, q.y, q.z, q.w}, {p.x, p.y, p.z}};
}

}  // namespace gazeloop::present
