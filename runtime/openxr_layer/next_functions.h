#pragma once

#include "runtime/openxr/xr_check.h"
#include "runtime/openxr_layer/loader_interface.h"
#include "runtime/openxr_layer/newer_openxr.h"

namespace gazeloop::openxr_layer {

/// Every function of OpenXR's core (1.0) that the layer stands in for or calls itself.
#define GAZELOOP_LAYER_NEXT(FUNCTION)           \
    FUNCTION(DestroyInstance)                   \
    FUNCTION(GetInstanceProperties)             \
    FUNCTION(PollEvent)                         \
    FUNCTION(GetSystem)                         \
    FUNCTION(GetSystemProperties)               \
    FUNCTION(StringToPath)                      \
    FUNCTION(PathToString)                      \
    FUNCTION(CreateSession)                     \
    FUNCTION(DestroySession)                    \
    FUNCTION(BeginSession)                      \
    FUNCTION(EnumerateViewConfigurations)       \
    FUNCTION(GetViewConfigurationProperties)    \
    FUNCTION(EnumerateViewConfigurationViews)   \
    FUNCTION(EnumerateEnvironmentBlendModes)    \
    FUNCTION(CreateSwapchain)                   \
    FUNCTION(DestroySwapchain)                  \
    FUNCTION(EnumerateSwapchainImages)          \
    FUNCTION(AcquireSwapchainImage)             \
    FUNCTION(WaitSwapchainImage)                \
    FUNCTION(ReleaseSwapchainImage)             \
    FUNCTION(CreateReferenceSpace)              \
    FUNCTION(CreateActionSpace)                 \
    FUNCTION(DestroySpace)                      \
    FUNCTION(LocateSpace)                       \
    FUNCTION(LocateViews)                       \
    FUNCTION(CreateActionSet)                   \
    FUNCTION(DestroyActionSet)                  \
    FUNCTION(CreateAction)                      \
    FUNCTION(DestroyAction)                     \
    FUNCTION(SuggestInteractionProfileBindings) \
    FUNCTION(AttachSessionActionSets)           \
    FUNCTION(SyncActions)                       \
    FUNCTION(GetActionStatePose)                \
    FUNCTION(GetCurrentInteractionProfile)      \
    FUNCTION(EnumerateBoundSourcesForAction)    \
    FUNCTION(GetInputSourceLocalizedName)       \
    FUNCTION(WaitFrame)                         \
    FUNCTION(BeginFrame)                        \
    FUNCTION(EndFrame)

/// The functions of whoever is below the layer, of one instance. Null: it has none by that name.
struct NextFunctions {
#define GAZELOOP_LAYER_MEMBER(name) PFN_xr##name name = nullptr;
    GAZELOOP_LAYER_NEXT(GAZELOOP_LAYER_MEMBER)
#undef GAZELOOP_LAYER_MEMBER
    newer::LocateSpaces LocateSpaces = nullptr;     ///< 1.1
    newer::LocateSpaces LocateSpacesKHR = nullptr;  ///< XR_KHR_locate_spaces
    PFN_xrGetVisibilityMaskKHR GetVisibilityMaskKHR = nullptr;
    PFN_xrConvertTimeToTimespecTimeKHR ConvertTimeToTimespecTimeKHR = nullptr;
    PFN_xrConvertTimespecTimeToTimeKHR ConvertTimespecTimeToTimeKHR = nullptr;
};

/// A function by its name; null where there is none.
template <typename Function>
Function function_of(PFN_xrGetInstanceProcAddr get, XrInstance instance, const char* name) {
    PFN_xrVoidFunction function = nullptr;
    return XR_SUCCEEDED(get(instance, name, &function)) ? reinterpret_cast<Function>(function)
                                                        : nullptr;
}

inline NextFunctions next_functions(PFN_xrGetInstanceProcAddr get, XrInstance instance) {
    NextFunctions next;
#define GAZELOOP_LAYER_FIND(name) \
    next.name = function_of<decltype(next.name)>(get, instance, "xr" #name);
    GAZELOOP_LAYER_NEXT(GAZELOOP_LAYER_FIND)
    GAZELOOP_LAYER_FIND(LocateSpaces)
    GAZELOOP_LAYER_FIND(LocateSpacesKHR)
    GAZELOOP_LAYER_FIND(GetVisibilityMaskKHR)
    GAZELOOP_LAYER_FIND(ConvertTimeToTimespecTimeKHR)
    GAZELOOP_LAYER_FIND(ConvertTimespecTimeToTimeKHR)
#undef GAZELOOP_LAYER_FIND
    return next;
}

}  // namespace gazeloop::openxr_layer
