// Foveation state for applications that foveate themselves: XR_FB_foveation and what belongs to it.
// No picture is changed here: profiles are kept as they were given, and the centre is told.
#include <cmath>

#include "runtime/openxr_layer/foveated_views.h"
#include "runtime/openxr_layer/hook.h"
#include "runtime/time/clock.h"

namespace gazeloop::openxr_layer {
namespace {

using Next = NextFunctions;

bool is_valid_level(const XrFoveationLevelProfileCreateInfoFB& level) {
    return level.level >= XR_FOVEATION_LEVEL_NONE_FB && level.level <= XR_FOVEATION_LEVEL_HIGH_FB &&
           (level.dynamic == XR_FOVEATION_DYNAMIC_DISABLED_FB ||
            level.dynamic == XR_FOVEATION_DYNAMIC_LEVEL_ENABLED_FB) &&
           std::isfinite(level.verticalOffset);
}

XrResult create_profile(const Instances::Pointer& layered, XrSession session,
                        const XrFoveationProfileCreateInfoFB* info, XrFoveationProfileFB* profile) {
    if (info == nullptr || profile == nullptr ||
        info->type != XR_TYPE_FOVEATION_PROFILE_CREATE_INFO_FB) {
        return XR_ERROR_VALIDATION_FAILURE;
    }
    const auto* const level = in_chain<XrFoveationLevelProfileCreateInfoFB>(
        info->next, XR_TYPE_FOVEATION_LEVEL_PROFILE_CREATE_INFO_FB);
    if (level != nullptr && !is_valid_level(*level)) {
        return XR_ERROR_VALIDATION_FAILURE;
    }
    const std::lock_guard lock(layered->mutex);
    LayeredSession* const known = layered->session(session);
    if (known == nullptr) {
        return XR_ERROR_HANDLE_INVALID;
    }
    // NOLINTNEXTLINE(performance-no-int-to-ptr): handles are numbers to whoever gets them
    *profile = reinterpret_cast<XrFoveationProfileFB>(++layered->made_handles);
    known->foveation_profiles.insert(*profile);
    Instances::all().add_child(*profile, layered, session);
    return XR_SUCCESS;
}

XrResult destroy_profile(const Instances::Pointer& layered, XrFoveationProfileFB profile) {
    const std::lock_guard lock(layered->mutex);
    for (auto& [handle, session] : layered->sessions) {
        if (session.foveation_profiles.erase(profile) > 0) {
            Instances::all().remove_child(profile);
            return XR_SUCCESS;
        }
    }
    return XR_ERROR_HANDLE_INVALID;
}

/// The session of a swapchain that is known; null: it is none of the application's.
LayeredSession* session_with(LayeredInstance& layered, XrSwapchain swapchain) {
    for (auto& [handle, session] : layered.sessions) {
        if (session.foveation.contains(swapchain)) {
            return &session;
        }
    }
    return nullptr;
}

/// A profile may be destroyed right after it was applied: it counts on.
XrResult update_swapchain(const Instances::Pointer& layered, XrSwapchain swapchain,
                          const XrSwapchainStateBaseHeaderFB* state) {
    if (state == nullptr || state->type != XR_TYPE_SWAPCHAIN_STATE_FOVEATION_FB) {
        return XR_ERROR_VALIDATION_FAILURE;
    }
    const auto& foveation = *reinterpret_cast<const XrSwapchainStateFoveationFB*>(state);
    if (foveation.flags != 0) {
        return XR_ERROR_VALIDATION_FAILURE;
    }
    const std::lock_guard lock(layered->mutex);
    LayeredSession* const known = session_with(*layered, swapchain);
    if (known == nullptr || !known->foveation_profiles.contains(foveation.profile)) {
        return XR_ERROR_HANDLE_INVALID;
    }
    known->foveation[swapchain] = foveation.profile;
    return XR_SUCCESS;
}

XrResult get_swapchain_state(const Instances::Pointer& layered, XrSwapchain swapchain,
                             XrSwapchainStateBaseHeaderFB* state) {
    if (state == nullptr || state->type != XR_TYPE_SWAPCHAIN_STATE_FOVEATION_FB) {
        return XR_ERROR_VALIDATION_FAILURE;
    }
    const std::lock_guard lock(layered->mutex);
    const LayeredSession* const known = session_with(*layered, swapchain);
    if (known == nullptr) {
        return XR_ERROR_HANDLE_INVALID;
    }
    auto& foveation = *reinterpret_cast<XrSwapchainStateFoveationFB*>(state);
    foveation.flags = 0;
    foveation.profile = known->foveation.at(swapchain);
    return XR_SUCCESS;
}

XrResult get_foveation_state(const Instances::Pointer& layered, XrSession session,
                             newer::FoveationEyeTrackedState* state) {
    if (state == nullptr || state->type != newer::kFoveationEyeTrackedState ||
        state->next != nullptr) {
        return XR_ERROR_VALIDATION_FAILURE;
    }
    state->foveationCenter[0] = state->foveationCenter[1] = {};
    state->flags = 0;
    const std::lock_guard lock(layered->mutex);
    LayeredSession* const known = layered->session(session);
    if (known == nullptr) {
        return XR_ERROR_HANDLE_INVALID;
    }
    const auto display =
        known->display ? known->display : layered->times.xr_time(time::monotonic_ns());
    const auto seen = display ? foveated_views(*layered, *known, *display) : std::nullopt;
    if (!seen || !seen->follows_gaze()) {
        return XR_SUCCESS;
    }
    for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
        const CentredPlace place =
            centred_place(seen->fovea.eyes[eye].position, seen->views_in_head[eye]);
        state->foveationCenter[eye] = {static_cast<float>(place.x), static_cast<float>(place.y)};
    }
    state->flags = newer::kFoveationEyeTrackedStateValid;
    layered->note_foveation_read(*known);
    return XR_SUCCESS;
}

bool owns_profiles(const LayeredInstance& layered) { return layered.owns.foveation_profiles; }
bool owns_swapchain_state(const LayeredInstance& layered) { return layered.owns.swapchain_state; }
bool owns_foveation_state(const LayeredInstance& layered) { return layered.owns.foveation_state; }

}  // namespace

std::span<const Hook> foveation_hooks() {
    static const std::array kHooks{
        own_hook<PFN_xrCreateFoveationProfileFB, &create_profile>("xrCreateFoveationProfileFB",
                                                                  &owns_profiles),
        own_hook<PFN_xrDestroyFoveationProfileFB, &destroy_profile>("xrDestroyFoveationProfileFB",
                                                                    &owns_profiles),
        own_hook<PFN_xrUpdateSwapchainFB, &update_swapchain>("xrUpdateSwapchainFB",
                                                             &owns_swapchain_state),
        own_hook<PFN_xrGetSwapchainStateFB, &get_swapchain_state>("xrGetSwapchainStateFB",
                                                                  &owns_swapchain_state),
        own_hook<newer::GetFoveationEyeTrackedState, &get_foveation_state>(
            "xrGetFoveationEyeTrackedStateMETA", &owns_foveation_state),
    };
    return kHooks;
}

}  // namespace gazeloop::openxr_layer
