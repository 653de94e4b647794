#pragma once

#define XR_USE_GRAPHICS_API_VULKAN
#define XR_USE_TIMESPEC
#include <vulkan/vulkan.h>
#include <ctime>
// After what they need.
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

#include <cstring>
#include <deque>
#include <optional>
#include <string_view>

#include "tests/support/faults/fault_plan.h"

/// An OpenXR API layer that does what a real runtime below it cannot be made to do:
/// XR_APILAYER_GAZELOOP_faults. GAZELOOP_OPENXR_FAULTS says which calls (see fault_plan.h). For
/// every function that is named in one of the files here, the effect is the name of an XrResult,
/// which is returned without calling the runtime. For other effects see the files.
namespace gazeloop::tests {

/// One process, one instance, one session: what gazeloop has.
struct Layer {
    FaultPlan plan = FaultPlan::from_environment("GAZELOOP_OPENXR_FAULTS");
    PFN_xrGetInstanceProcAddr next_proc = nullptr;
    XrInstance instance = XR_NULL_HANDLE;
    XrSession session = XR_NULL_HANDLE;
    std::deque<XrEventDataBuffer> events;  ///< to be polled before the runtime's
};
Layer& layer();

/// The function of the layer or runtime below.
template <typename Function>
Function next(const char* name) {
    PFN_xrVoidFunction function = nullptr;
    layer().next_proc(layer().instance, name, &function);
    return reinterpret_cast<Function>(function);
}

template <typename Function>
PFN_xrVoidFunction as_hook(Function function) {
    return reinterpret_cast<PFN_xrVoidFunction>(function);
}

/// The result of that name; none if there is none.
std::optional<XrResult> result_named(std::string_view text);

/// What the plan says of the next call of a function that can only fail: the result to give
/// without calling down, if any.
std::optional<XrResult> failure_of(std::string_view function);

template <typename Event>
void send(const Event& event) {
    XrEventDataBuffer buffer{};
    static_assert(sizeof event <= sizeof buffer);
    std::memcpy(&buffer, &event, sizeof event);
    layer().events.push_back(buffer);
}

/// Moves the origin of LOCAL space if that is what an effect of xrWaitFrame says
/// (moved_origin.cpp); `state` is the frame's.
bool move_origin(std::string_view effect, const XrFrameState& state);
/// A pose that the runtime gave in a space for a time, where the origin has been moved.
XrPosef in_moved_space(const XrPosef& pose, XrSpace space, XrTime time);

// What stands in for a function of that name; null: nothing does.

/// frame_faults.cpp: session, frames, views.
PFN_xrVoidFunction frame_hook(std::string_view name);
/// moved_origin.cpp: spaces.
PFN_xrVoidFunction space_hook(std::string_view name);
/// mask_faults.cpp: what the headset hides.
PFN_xrVoidFunction mask_hook(std::string_view name);
/// buttons.cpp: controllers.
PFN_xrVoidFunction button_hook(std::string_view name);
/// eye_gaze.cpp: XR_EXT_eye_gaze_interaction, from a file.
PFN_xrVoidFunction eye_gaze_hook(std::string_view name);

/// Whether the layer itself provides eye gaze (eye_gaze.cpp), which is not to reach the runtime.
bool provides_eye_gaze();
/// Where the space is the gaze's: the answer to xrLocateSpace.
std::optional<XrResult> locate_gaze(XrSpace space, XrTime time, XrSpaceLocation* location);

}  // namespace gazeloop::tests
