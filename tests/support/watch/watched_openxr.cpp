// The calls of OpenXR that a frame makes, as WatchedCalls: the linker (--wrap) sends ours here.
#include <openxr/openxr.h>

#include "tests/support/watch/watched_call.h"

using gazeloop::tests::WatchedCall;

#define GAZELOOP_WATCH(name, parameters, arguments) \
    XrResult __real_##name parameters;              \
    XrResult __wrap_##name parameters;              \
    XrResult __wrap_##name parameters {             \
        const WatchedCall watched;                  \
        return __real_##name arguments;             \
    }

// NOLINTBEGIN(bugprone-reserved-identifier): the names that the linker asks for
extern "C" {
GAZELOOP_WATCH(xrPollEvent, (XrInstance instance, XrEventDataBuffer* event), (instance, event))
GAZELOOP_WATCH(xrWaitFrame, (XrSession session, const XrFrameWaitInfo* info, XrFrameState* state),
               (session, info, state))
GAZELOOP_WATCH(xrBeginFrame, (XrSession session, const XrFrameBeginInfo* info), (session, info))
GAZELOOP_WATCH(xrEndFrame, (XrSession session, const XrFrameEndInfo* info), (session, info))
GAZELOOP_WATCH(xrLocateViews,
               (XrSession session, const XrViewLocateInfo* info, XrViewState* state,
                uint32_t capacity, uint32_t* count, XrView* views),
               (session, info, state, capacity, count, views))
GAZELOOP_WATCH(xrLocateSpace, (XrSpace space, XrSpace base, XrTime time, XrSpaceLocation* location),
               (space, base, time, location))
GAZELOOP_WATCH(xrSyncActions, (XrSession session, const XrActionsSyncInfo* info), (session, info))
GAZELOOP_WATCH(xrGetActionStatePose,
               (XrSession session, const XrActionStateGetInfo* info, XrActionStatePose* state),
               (session, info, state))
GAZELOOP_WATCH(xrGetCurrentInteractionProfile,
               (XrSession session, XrPath user, XrInteractionProfileState* state),
               (session, user, state))
GAZELOOP_WATCH(xrAcquireSwapchainImage,
               (XrSwapchain swapchain, const XrSwapchainImageAcquireInfo* info, uint32_t* index),
               (swapchain, info, index))
GAZELOOP_WATCH(xrWaitSwapchainImage, (XrSwapchain swapchain, const XrSwapchainImageWaitInfo* info),
               (swapchain, info))
GAZELOOP_WATCH(xrReleaseSwapchainImage,
               (XrSwapchain swapchain, const XrSwapchainImageReleaseInfo* info), (swapchain, info))
}
// NOLINTEND(bugprone-reserved-identifier)
