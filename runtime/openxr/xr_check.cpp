#include "runtime/openxr/xr_check.h"

#include <fmt/core.h>
#include <openxr/openxr_reflection.h>

#include <cmath>

#include "runtime/error.h"

namespace gazeloop::openxr {

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

namespace {

bool went_away(XrResult result) {
    return result == XR_ERROR_INSTANCE_LOST || result == XR_ERROR_SESSION_LOST ||
           result == XR_ERROR_RUNTIME_FAILURE;
}

}  // namespace

XrResult xr_check(XrResult result, std::string_view what) {
    if (XR_SUCCEEDED(result)) {
        return result;
    }
    throw SetupError(went_away(result) ? ErrorKind::SessionLost : ErrorKind::NoDevice,
                     fmt::format("OpenXR: {}: {}", what, xr_name(result)));
}

XrResult xr_check_session(XrResult result, std::string_view call) {
    if (XR_SUCCEEDED(result)) {
        return result;
    }
    throw SetupError(
        ErrorKind::SessionLost,
        went_away(result)
            ? fmt::format("OpenXR: the runtime or its session went away ({}: {}): see that the "
                          "runtime runs and the headset is connected, then start again",
                          call, xr_name(result))
            : fmt::format("OpenXR: the runtime refused a call of a running session ({}: {}): its "
                          "log may say why; start again, or use another runtime",
                          call, xr_name(result)));
}

std::optional<gaze::Pose> from_xr(const XrPosef& pose) {
    const glm::dquat orientation(pose.orientation.w, pose.orientation.x, pose.orientation.y,
                                 pose.orientation.z);
    const glm::dvec3 position_m(pose.position.x, pose.position.y, pose.position.z);
    // OpenXR wants unit length within 1 %; what is far from it says nothing.
    const double length = glm::length(orientation);
    if (!(length > 0.5 && length < 2.0) ||
        !std::isfinite(position_m.x + position_m.y + position_m.z)) {
        return std::nullopt;
    }
    return gaze::Pose{glm::normalize(orientation), position_m};
}

XrPosef to_xr(const gaze::Pose& pose) {
    const glm::quat q(pose.orientation);
    const glm::vec3 p(pose.position_m);
    return {{q.x, q.y, q.z, q.w}, {p.x, p.y, p.z}};
}

}  // namespace gazeloop::openxr
