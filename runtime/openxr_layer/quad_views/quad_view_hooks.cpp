// Four views for two: what applications are told of them, and their swapchains. Views are located
// and frames ended in frame_hooks.cpp.
#include <algorithm>
#include <array>

#include "runtime/openxr_layer/hook.h"

namespace gazeloop::openxr_layer {
namespace {

using Next = NextFunctions;

constexpr auto kStereo = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;

XrResult enumerate_configurations(Call<&Next::EnumerateViewConfigurations>& call,
                                  XrInstance instance, XrSystemId system, std::uint32_t capacity,
                                  std::uint32_t* count, XrViewConfigurationType* types) {
    XrViewConfigurationType* const none = nullptr;
    const std::uint32_t zero = 0;
    if (count == nullptr) {
        return call.down(instance, system, capacity, count, types);
    }
    if (const XrResult result = call.down(instance, system, zero, count, none); XR_FAILED(result)) {
        return result;
    }
    const std::uint32_t below = (*count)++;
    if (capacity == 0) {
        return XR_SUCCESS;
    }
    if (capacity < *count || types == nullptr) {
        return types == nullptr ? XR_ERROR_VALIDATION_FAILURE : XR_ERROR_SIZE_INSUFFICIENT;
    }
    std::uint32_t written = 0;
    if (const XrResult result = call.down(instance, system, below, &written, types);
        XR_FAILED(result)) {
        return result;
    }
    types[written] = kQuadViews;
    *count = written + 1;
    return XR_SUCCESS;
}

XrResult get_properties(Call<&Next::GetViewConfigurationProperties>& call, XrInstance instance,
                        XrSystemId system, XrViewConfigurationType type,
                        XrViewConfigurationProperties* properties) {
    if (type != kQuadViews) {
        return call.down(instance, system, type, properties);
    }
    const XrViewConfigurationType stereo = kStereo;
    const XrResult result = call.down(instance, system, stereo, properties);
    if (XR_SUCCEEDED(result)) {
        properties->viewConfigurationType = kQuadViews;
        properties->fovMutable = XR_TRUE;  // insets move
    }
    return result;
}

/// Of one view of the full picture, that of a part of it.
void resize(XrViewConfigurationView& view, const PictureSize& size) {
    view.recommendedImageRectWidth = std::min(size.width_px, view.maxImageRectWidth);
    view.recommendedImageRectHeight = std::min(size.height_px, view.maxImageRectHeight);
}

XrResult enumerate_views(Call<&Next::EnumerateViewConfigurationViews>& call, XrInstance instance,
                         XrSystemId system, XrViewConfigurationType type, std::uint32_t capacity,
                         std::uint32_t* count, XrViewConfigurationView* views) {
    if (type != kQuadViews || count == nullptr) {
        return call.down(instance, system, type, capacity, count, views);
    }
    const XrViewConfigurationType stereo = kStereo;
    std::array<XrViewConfigurationView, gaze::kEyeCount> two{};
    for (XrViewConfigurationView& view : two) {
        view.type = XR_TYPE_VIEW_CONFIGURATION_VIEW;
    }
    const auto two_count = static_cast<std::uint32_t>(two.size());
    std::uint32_t written = 0;
    if (const XrResult result =
            call.down(instance, system, stereo, two_count, &written, two.data());
        XR_FAILED(result)) {
        return result;
    }
    *count = kQuadViewCount;
    if (capacity == 0) {
        return XR_SUCCESS;
    }
    if (capacity < kQuadViewCount || views == nullptr) {
        return views == nullptr ? XR_ERROR_VALIDATION_FAILURE : XR_ERROR_SIZE_INSUFFICIENT;
    }
    const PictureSize full{
        std::max(two[0].recommendedImageRectWidth, two[1].recommendedImageRectWidth),
        std::max(two[0].recommendedImageRectHeight, two[1].recommendedImageRectHeight)};
    const QuadSizes sizes = quad_sizes(full, call.instance().inset_policy);
    for (std::uint32_t i = 0; i < kQuadViewCount; ++i) {
        if (views[i].type != XR_TYPE_VIEW_CONFIGURATION_VIEW) {
            return XR_ERROR_VALIDATION_FAILURE;
        }
        void* const next = views[i].next;
        views[i] = two[i % gaze::kEyeCount];
        views[i].next = next;
        resize(views[i], i < gaze::kEyeCount ? sizes.outer : sizes.inset);
    }
    return XR_SUCCESS;
}

XrResult enumerate_blend_modes(Call<&Next::EnumerateEnvironmentBlendModes>& call,
                               XrInstance instance, XrSystemId system, XrViewConfigurationType type,
                               std::uint32_t capacity, std::uint32_t* count,
                               XrEnvironmentBlendMode* modes) {
    const XrViewConfigurationType passed = type == kQuadViews ? kStereo : type;
    return call.down(instance, system, passed, capacity, count, modes);
}

std::shared_ptr<QuadSession> quad_of(LayeredInstance& layered, XrSession session) {
    const std::lock_guard lock(layered.mutex);
    const LayeredSession* const known = layered.session(session);
    return known != nullptr ? known->quad : nullptr;
}
std::shared_ptr<QuadSession> quad_of(LayeredInstance& layered, XrSwapchain swapchain) {
    return quad_of(layered, Instances::all().session_of(swapchain));
}

XrResult begin_session(Call<&Next::BeginSession>& call, XrSession session,
                       const XrSessionBeginInfo* info) {
    const bool four = info != nullptr && info->primaryViewConfigurationType == kQuadViews;
    const auto quad = quad_of(call.instance(), session);
    if (four && quad == nullptr) {
        return XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED;
    }
    XrSessionBeginInfo passed_on = info != nullptr ? *info : XrSessionBeginInfo{};
    passed_on.primaryViewConfigurationType =
        four ? kStereo : passed_on.primaryViewConfigurationType;
    const XrSessionBeginInfo* const passed = info != nullptr ? &passed_on : nullptr;
    const XrResult result = call.down(session, passed);
    if (XR_SUCCEEDED(result) && quad != nullptr) {
        quad->begin(four);
    }
    return result;
}

/// Nothing of an inset is hidden: what lies outside the display the outer view leaves out.
XrResult get_visibility_mask(Call<&Next::GetVisibilityMaskKHR>& call, XrSession session,
                             XrViewConfigurationType type, std::uint32_t view,
                             XrVisibilityMaskTypeKHR mask_type, XrVisibilityMaskKHR* mask) {
    if (type != kQuadViews) {
        return call.down(session, type, view, mask_type, mask);
    }
    const XrViewConfigurationType stereo = kStereo;
    if (view < gaze::kEyeCount) {
        return call.down(session, stereo, view, mask_type, mask);
    }
    if (view >= kQuadViewCount || mask == nullptr || mask->type != XR_TYPE_VISIBILITY_MASK_KHR) {
        return XR_ERROR_VALIDATION_FAILURE;
    }
    mask->vertexCountOutput = mask->indexCountOutput = 0;
    return XR_SUCCESS;
}

/// What is drawn must be read.
XrResult create_swapchain(Call<&Next::CreateSwapchain>& call, XrSession session,
                          const XrSwapchainCreateInfo* info, XrSwapchain* swapchain) {
    const auto quad = quad_of(call.instance(), session);
    XrSwapchainCreateInfo passed_on = info != nullptr ? *info : XrSwapchainCreateInfo{};
    if (quad != nullptr && (passed_on.usageFlags & XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT) != 0) {
        passed_on.usageFlags |= XR_SWAPCHAIN_USAGE_SAMPLED_BIT;
    }
    const XrSwapchainCreateInfo* const passed = info != nullptr ? &passed_on : nullptr;
    const XrResult result = call.down(session, passed, swapchain);
    if (XR_FAILED(result)) {
        return result;
    }
    Instances::all().add_child(*swapchain, call.pointer(), session);
    {
        const std::lock_guard lock(call.instance().mutex);
        if (LayeredSession* const known = call.instance().session(session)) {
            known->foveation[*swapchain] = XR_NULL_HANDLE;
        }
    }
    if (quad != nullptr) {
        quad->add(*swapchain, passed_on);
    }
    return result;
}

XrResult destroy_swapchain(Call<&Next::DestroySwapchain>& call, XrSwapchain swapchain) {
    if (const auto quad = quad_of(call.instance(), swapchain)) {
        quad->remove(swapchain);
    }
    {
        const std::lock_guard lock(call.instance().mutex);
        for (auto& [handle, session] : call.instance().sessions) {
            session.foveation.erase(swapchain);
        }
    }
    Instances::all().remove_child(swapchain);
    return call.down(swapchain);
}

XrResult acquire(Call<&Next::AcquireSwapchainImage>& call, XrSwapchain swapchain,
                 const XrSwapchainImageAcquireInfo* info, std::uint32_t* index) {
    const auto quad = quad_of(call.instance(), swapchain);
    return quad != nullptr ? quad->acquire(swapchain, info, index)
                           : call.down(swapchain, info, index);
}

XrResult wait(Call<&Next::WaitSwapchainImage>& call, XrSwapchain swapchain,
              const XrSwapchainImageWaitInfo* info) {
    const auto quad = quad_of(call.instance(), swapchain);
    return quad != nullptr ? quad->wait(swapchain, info) : call.down(swapchain, info);
}

XrResult release(Call<&Next::ReleaseSwapchainImage>& call, XrSwapchain swapchain,
                 const XrSwapchainImageReleaseInfo* info) {
    const auto quad = quad_of(call.instance(), swapchain);
    return quad != nullptr ? quad->release(swapchain, info) : call.down(swapchain, info);
}

/// For whoever has asked for four views only.
template <auto Next, auto Work>
Hook quad_hook(std::string_view name) {
    Hook made = hook<Next, Work>(name);
    made.is_there = [](const LayeredInstance& layered) {
        return layered.owns.quad_views && layered.next.*Next != nullptr;
    };
    return made;
}

}  // namespace

std::span<const Hook> quad_view_hooks() {
    static const std::array kHooks{
        quad_hook<&Next::EnumerateViewConfigurations, &enumerate_configurations>(
            "xrEnumerateViewConfigurations"),
        quad_hook<&Next::GetViewConfigurationProperties, &get_properties>(
            "xrGetViewConfigurationProperties"),
        quad_hook<&Next::EnumerateViewConfigurationViews, &enumerate_views>(
            "xrEnumerateViewConfigurationViews"),
        quad_hook<&Next::EnumerateEnvironmentBlendModes, &enumerate_blend_modes>(
            "xrEnumerateEnvironmentBlendModes"),
        quad_hook<&Next::BeginSession, &begin_session>("xrBeginSession"),
        quad_hook<&Next::GetVisibilityMaskKHR, &get_visibility_mask>("xrGetVisibilityMaskKHR"),
        quad_hook<&Next::AcquireSwapchainImage, &acquire>("xrAcquireSwapchainImage"),
        quad_hook<&Next::WaitSwapchainImage, &wait>("xrWaitSwapchainImage"),
        quad_hook<&Next::ReleaseSwapchainImage, &release>("xrReleaseSwapchainImage"),
        // These foveation asks for too: of swapchains it must know.
        hook<&Next::CreateSwapchain, &create_swapchain>("xrCreateSwapchain"),
        hook<&Next::DestroySwapchain, &destroy_swapchain>("xrDestroySwapchain"),
    };
    return kHooks;
}

}  // namespace gazeloop::openxr_layer
