#pragma once

#define XR_USE_GRAPHICS_API_VULKAN
#define XR_USE_TIMESPEC
#include <time.h>
#include <vulkan/vulkan.h>
// After what it needs.
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

#include <optional>
#include <string_view>

#include "runtime/gaze/pose.h"

namespace gazeloop::openxr {

/// Throws SetupError for a failed call of the set-up: SessionLost when instance, session or runtime
/// went away, NoDevice otherwise. `what` names the call and, where there is one, the remedy.
/// Success codes (also XR_SESSION_LOSS_PENDING, XR_FRAME_DISCARDED) pass and are returned.
XrResult xr_check(XrResult result, std::string_view what);

/// The same for a call of a running session, which no failure lets go on: always SessionLost.
XrResult xr_check_session(XrResult result, std::string_view call);

/// The name of a result, "XR_ERROR_..." .
std::string_view xr_name(XrResult result);

/// An OpenXR structure of its type, all else zero.
template <typename Structure>
Structure typed(XrStructureType type) {
    Structure structure{};
    structure.type = type;
    return structure;
}

/// Nothing for a pose that is not finite or whose quaternion is no rotation.
std::optional<gaze::Pose> from_xr(const XrPosef& pose);
XrPosef to_xr(const gaze::Pose& pose);

/// An extension's function. Throws SetupError (NoDevice) if the runtime has none by that name.
template <typename Function>
Function xr_function(XrInstance instance, const char* name) {
    PFN_xrVoidFunction function = nullptr;
    xr_check(xrGetInstanceProcAddr(instance, name, &function), name);
    return reinterpret_cast<Function>(function);
}

}  // namespace gazeloop::openxr
