#include "tests/unit/openxr_layer/mock_runtime.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <string_view>

#include "runtime/time/clock.h"
#include "tests/support/layer_in_process.h"

namespace gazeloop::openxr_layer {
namespace {

MockRuntime& mock() { return MockRuntime::the(); }

template <typename Handle>
std::uint64_t number(Handle handle) {
    return reinterpret_cast<std::uint64_t>(handle);
}
template <typename Handle>
XrResult make(Handle* handle) {
    // NOLINTNEXTLINE(performance-no-int-to-ptr): a number, as any runtime's handles
    *handle = reinterpret_cast<Handle>(mock().make_handle());
    return XR_SUCCESS;
}
template <typename Handle>
bool lives(Handle handle) {
    return mock().lives(number(handle));
}

#define GAZELOOP_MOCK_CHECK(name, handle)                                       \
    const std::lock_guard lock(mock().mutex());                                 \
    if (!lives(handle)) {                                                       \
        return XR_ERROR_HANDLE_INVALID;                                         \
    }                                                                           \
    if (const XrResult failure = mock().failure_of(name); XR_FAILED(failure)) { \
        return failure;                                                         \
    }

XrResult destroy_instance(XrInstance instance) {
    GAZELOOP_MOCK_CHECK("xrDestroyInstance", instance)
    mock().end_instance(reinterpret_cast<std::uint64_t>(instance));
    return XR_SUCCESS;
}
XrResult get_instance_properties(XrInstance instance, XrInstanceProperties* properties) {
    GAZELOOP_MOCK_CHECK("xrGetInstanceProperties", instance)
    std::strcpy(properties->runtimeName, "mock");
    return XR_SUCCESS;
}
XrResult poll_event(XrInstance instance, XrEventDataBuffer*) {
    GAZELOOP_MOCK_CHECK("xrPollEvent", instance)
    return XR_EVENT_UNAVAILABLE;
}
XrResult get_system(XrInstance instance, const XrSystemGetInfo*, XrSystemId* system) {
    GAZELOOP_MOCK_CHECK("xrGetSystem", instance)
    *system = 1;
    return XR_SUCCESS;
}
XrResult get_system_properties(XrInstance instance, XrSystemId, XrSystemProperties*) {
    GAZELOOP_MOCK_CHECK("xrGetSystemProperties", instance)
    return XR_SUCCESS;
}
XrResult string_to_path(XrInstance instance, const char* text, XrPath* path) {
    GAZELOOP_MOCK_CHECK("xrStringToPath", instance)
    *path = mock().path_of(text);
    return XR_SUCCESS;
}
XrResult create_session(XrInstance instance, const XrSessionCreateInfo*, XrSession* session) {
    GAZELOOP_MOCK_CHECK("xrCreateSession", instance)
    return make(session);
}
XrResult destroy_session(XrSession session) {
    GAZELOOP_MOCK_CHECK("xrDestroySession", session)
    mock().end(number(session));
    return XR_SUCCESS;
}
XrResult enumerate_configurations(XrInstance instance, XrSystemId, std::uint32_t capacity,
                                  std::uint32_t* count, XrViewConfigurationType* types) {
    GAZELOOP_MOCK_CHECK("xrEnumerateViewConfigurations", instance)
    *count = 1;
    if (capacity > 0) {
        types[0] = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
    }
    return XR_SUCCESS;
}
XrResult get_configuration_properties(XrInstance instance, XrSystemId, XrViewConfigurationType type,
                                      XrViewConfigurationProperties* properties) {
    GAZELOOP_MOCK_CHECK("xrGetViewConfigurationProperties", instance)
    if (type != XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO) {
        return XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED;
    }
    properties->viewConfigurationType = type;
    properties->fovMutable = XR_FALSE;
    return XR_SUCCESS;
}
XrResult enumerate_views(XrInstance instance, XrSystemId, XrViewConfigurationType type,
                         std::uint32_t capacity, std::uint32_t* count,
                         XrViewConfigurationView* views) {
    GAZELOOP_MOCK_CHECK("xrEnumerateViewConfigurationViews", instance)
    if (type != XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO) {
        return XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED;
    }
    *count = 2;
    for (std::uint32_t i = 0; i < 2 && capacity >= 2; ++i) {
        void* const next = views[i].next;
        views[i] = {XR_TYPE_VIEW_CONFIGURATION_VIEW, next, 1600, 4096, 1600, 4096, 1, 1};
    }
    return XR_SUCCESS;
}
XrResult begin_session(XrSession session, const XrSessionBeginInfo* info) {
    GAZELOOP_MOCK_CHECK("xrBeginSession", session)
    return info->primaryViewConfigurationType == XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO
               ? XR_SUCCESS
               : XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED;
}
XrResult enumerate_images(XrSwapchain swapchain, std::uint32_t capacity, std::uint32_t* count,
                          XrSwapchainImageBaseHeader* images) {
    GAZELOOP_MOCK_CHECK("xrEnumerateSwapchainImages", swapchain)
    *count = 3;
    for (std::uint32_t i = 0; i < 3 && capacity >= 3; ++i) {
        reinterpret_cast<XrSwapchainImageVulkanKHR*>(images)[i].image = VK_NULL_HANDLE;
    }
    return XR_SUCCESS;
}
XrResult acquire_image(XrSwapchain swapchain, const XrSwapchainImageAcquireInfo*,
                       std::uint32_t* index) {
    GAZELOOP_MOCK_CHECK("xrAcquireSwapchainImage", swapchain)
    return mock().acquire(number(swapchain), *index);
}
XrResult wait_image(XrSwapchain swapchain, const XrSwapchainImageWaitInfo*) {
    GAZELOOP_MOCK_CHECK("xrWaitSwapchainImage", swapchain)
    return mock().wait(number(swapchain));
}
XrResult release_image(XrSwapchain swapchain, const XrSwapchainImageReleaseInfo*) {
    GAZELOOP_MOCK_CHECK("xrReleaseSwapchainImage", swapchain)
    return mock().release(number(swapchain));
}
XrResult create_swapchain(XrSession session, const XrSwapchainCreateInfo*, XrSwapchain* swapchain) {
    GAZELOOP_MOCK_CHECK("xrCreateSwapchain", session)
    return make(swapchain);
}
XrResult destroy_swapchain(XrSwapchain swapchain) {
    GAZELOOP_MOCK_CHECK("xrDestroySwapchain", swapchain)
    mock().end(number(swapchain));
    return XR_SUCCESS;
}
XrResult create_reference_space(XrSession session, const XrReferenceSpaceCreateInfo*,
                                XrSpace* space) {
    GAZELOOP_MOCK_CHECK("xrCreateReferenceSpace", session)
    return make(space);
}
XrResult create_action_space(XrSession session, const XrActionSpaceCreateInfo* info,
                             XrSpace* space) {
    GAZELOOP_MOCK_CHECK("xrCreateActionSpace", session)
    if (mock().is_of_eyes(info->subactionPath)) {
        mock().see_eyes();
    }
    return lives(info->action) ? make(space) : XR_ERROR_HANDLE_INVALID;
}
XrResult destroy_space(XrSpace space) {
    GAZELOOP_MOCK_CHECK("xrDestroySpace", space)
    mock().end(number(space));
    return XR_SUCCESS;
}
XrResult locate_space(XrSpace space, XrSpace base, XrTime time, XrSpaceLocation* location) {
    GAZELOOP_MOCK_CHECK("xrLocateSpace", space)
    if (!lives(base)) {
        return XR_ERROR_HANDLE_INVALID;
    }
    if (time <= 0) {
        return XR_ERROR_TIME_INVALID;
    }
    const double half = std::fmod(static_cast<double>(time) * 1e-9, 6.0) / 2.0;
    location->locationFlags = 0xF;
    location->pose = {
        {0.0F, static_cast<float>(std::sin(half)), 0.0F, static_cast<float>(std::cos(half))},
        {0.1F, 1.6F, 0.2F}};
    auto* const next = static_cast<XrSpaceVelocity*>(location->next);
    if (next != nullptr && next->type == XR_TYPE_SPACE_VELOCITY) {
        next->velocityFlags =
            XR_SPACE_VELOCITY_LINEAR_VALID_BIT | XR_SPACE_VELOCITY_ANGULAR_VALID_BIT;
        next->linearVelocity = {};
        next->angularVelocity = {0.0F, 1.0F, 0.0F};
    }
    return XR_SUCCESS;
}
XrResult locate_views(XrSession session, const XrViewLocateInfo* info, XrViewState* state,
                      std::uint32_t capacity, std::uint32_t* count, XrView* views) {
    GAZELOOP_MOCK_CHECK("xrLocateViews", session)
    if (!lives(info->space)) {
        return XR_ERROR_HANDLE_INVALID;
    }
    *count = 2;
    state->viewStateFlags = 0xF;
    for (std::uint32_t i = 0; i < 2 && capacity >= 2; ++i) {
        views[i].pose = {{0.0F, 0.0F, 0.0F, 1.0F}, {i == 0 ? -0.03F : 0.03F, 1.6F, 0.0F}};
        views[i].fov = {-0.8F, 0.8F, 0.7F, -0.7F};
    }
    return XR_SUCCESS;
}
XrResult create_action_set(XrInstance instance, const XrActionSetCreateInfo*, XrActionSet* set) {
    GAZELOOP_MOCK_CHECK("xrCreateActionSet", instance)
    return make(set);
}
XrResult destroy_action_set(XrActionSet set) {
    GAZELOOP_MOCK_CHECK("xrDestroyActionSet", set)
    mock().end(number(set));
    return XR_SUCCESS;
}
XrResult create_action(XrActionSet set, const XrActionCreateInfo* info, XrAction* action) {
    GAZELOOP_MOCK_CHECK("xrCreateAction", set)
    for (std::uint32_t i = 0; i < info->countSubactionPaths; ++i) {
        if (mock().is_of_eyes(info->subactionPaths[i])) {
            mock().see_eyes();
        }
    }
    return make(action);
}
XrResult destroy_action(XrAction action) {
    GAZELOOP_MOCK_CHECK("xrDestroyAction", action)
    mock().end(number(action));
    return XR_SUCCESS;
}
XrResult suggest(XrInstance instance, const XrInteractionProfileSuggestedBinding* suggested) {
    GAZELOOP_MOCK_CHECK("xrSuggestInteractionProfileBindings", instance)
    if (mock().is_of_eyes(suggested->interactionProfile)) {
        mock().see_eyes();
    }
    return XR_SUCCESS;
}
XrResult attach(XrSession session, const XrSessionActionSetsAttachInfo*) {
    GAZELOOP_MOCK_CHECK("xrAttachSessionActionSets", session)
    return XR_SUCCESS;
}
XrResult sync(XrSession session, const XrActionsSyncInfo* info) {
    GAZELOOP_MOCK_CHECK("xrSyncActions", session)
    for (const XrActiveActionSet& set :
         std::span(info->activeActionSets, info->countActiveActionSets)) {
        if (mock().is_of_eyes(set.subactionPath)) {
            mock().see_eyes();
        }
        if (!lives(set.actionSet)) {
            return XR_ERROR_HANDLE_INVALID;
        }
    }
    return mock().focused() ? XR_SUCCESS : XR_SESSION_NOT_FOCUSED;
}
XrResult get_state(XrSession session, const XrActionStateGetInfo* info, XrActionStatePose* state) {
    GAZELOOP_MOCK_CHECK("xrGetActionStatePose", session)
    if (mock().is_of_eyes(info->subactionPath)) {
        mock().see_eyes();
    }
    state->isActive = XR_FALSE;
    return lives(info->action) ? XR_SUCCESS : XR_ERROR_HANDLE_INVALID;
}
XrResult get_profile(XrSession session, XrPath user, XrInteractionProfileState* state) {
    GAZELOOP_MOCK_CHECK("xrGetCurrentInteractionProfile", session)
    if (mock().is_of_eyes(user)) {
        mock().see_eyes();
    }
    state->interactionProfile = XR_NULL_PATH;
    return XR_SUCCESS;
}
XrResult bound_sources(XrSession session, const XrBoundSourcesForActionEnumerateInfo*,
                       std::uint32_t, std::uint32_t* count, XrPath*) {
    GAZELOOP_MOCK_CHECK("xrEnumerateBoundSourcesForAction", session)
    *count = 0;
    return XR_SUCCESS;
}
XrResult wait_frame(XrSession session, const XrFrameWaitInfo*, XrFrameState* state) {
    GAZELOOP_MOCK_CHECK("xrWaitFrame", session)
    state->predictedDisplayTime = MockRuntime::now() + 20'000'000;
    state->predictedDisplayPeriod = 11'000'000;
    state->shouldRender = XR_TRUE;
    return XR_SUCCESS;
}
XrResult begin_frame(XrSession session, const XrFrameBeginInfo*) {
    GAZELOOP_MOCK_CHECK("xrBeginFrame", session)
    return XR_SUCCESS;
}
XrResult end_frame(XrSession session, const XrFrameEndInfo* info) {
    GAZELOOP_MOCK_CHECK("xrEndFrame", session)
    mock().see_layers(*info);
    return XR_SUCCESS;
}
XrResult to_timespec(XrInstance instance, XrTime time, timespec* host) {
    GAZELOOP_MOCK_CHECK("xrConvertTimeToTimespecTimeKHR", instance)
    host->tv_sec = time / 1'000'000'000;
    host->tv_nsec = time % 1'000'000'000;
    return XR_SUCCESS;
}
XrResult from_timespec(XrInstance instance, const timespec* host, XrTime* time) {
    GAZELOOP_MOCK_CHECK("xrConvertTimespecTimeToTimeKHR", instance)
    *time = host->tv_sec * 1'000'000'000 + host->tv_nsec;
    return XR_SUCCESS;
}
#undef GAZELOOP_MOCK_CHECK

XrResult extensions(const char*, std::uint32_t capacity, std::uint32_t* count,
                    XrExtensionProperties* all) {
    *count = 1;
    if (capacity > 0) {
        std::strcpy(all[0].extensionName, XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME);
    }
    return XR_SUCCESS;
}

template <typename Function>
PFN_xrVoidFunction as_void(Function* function) {
    return reinterpret_cast<PFN_xrVoidFunction>(function);
}

XrResult get_proc(XrInstance, const char* name, PFN_xrVoidFunction* function) {
    static const std::map<std::string_view, PFN_xrVoidFunction> kFunctions{
        {"xrEnumerateInstanceExtensionProperties", as_void(&extensions)},
        {"xrDestroyInstance", as_void(&destroy_instance)},
        {"xrGetInstanceProperties", as_void(&get_instance_properties)},
        {"xrPollEvent", as_void(&poll_event)},
        {"xrGetSystem", as_void(&get_system)},
        {"xrGetSystemProperties", as_void(&get_system_properties)},
        {"xrStringToPath", as_void(&string_to_path)},
        {"xrCreateSession", as_void(&create_session)},
        {"xrDestroySession", as_void(&destroy_session)},
        {"xrEnumerateViewConfigurations", as_void(&enumerate_configurations)},
        {"xrGetViewConfigurationProperties", as_void(&get_configuration_properties)},
        {"xrEnumerateViewConfigurationViews", as_void(&enumerate_views)},
        {"xrBeginSession", as_void(&begin_session)},
        {"xrEnumerateSwapchainImages", as_void(&enumerate_images)},
        {"xrAcquireSwapchainImage", as_void(&acquire_image)},
        {"xrWaitSwapchainImage", as_void(&wait_image)},
        {"xrReleaseSwapchainImage", as_void(&release_image)},
        {"xrCreateSwapchain", as_void(&create_swapchain)},
        {"xrDestroySwapchain", as_void(&destroy_swapchain)},
        {"xrCreateReferenceSpace", as_void(&create_reference_space)},
        {"xrCreateActionSpace", as_void(&create_action_space)},
        {"xrDestroySpace", as_void(&destroy_space)},
        {"xrLocateSpace", as_void(&locate_space)},
        {"xrLocateViews", as_void(&locate_views)},
        {"xrCreateActionSet", as_void(&create_action_set)},
        {"xrDestroyActionSet", as_void(&destroy_action_set)},
        {"xrCreateAction", as_void(&create_action)},
        {"xrDestroyAction", as_void(&destroy_action)},
        {"xrSuggestInteractionProfileBindings", as_void(&suggest)},
        {"xrAttachSessionActionSets", as_void(&attach)},
        {"xrSyncActions", as_void(&sync)},
        {"xrGetActionStatePose", as_void(&get_state)},
        {"xrGetCurrentInteractionProfile", as_void(&get_profile)},
        {"xrEnumerateBoundSourcesForAction", as_void(&bound_sources)},
        {"xrWaitFrame", as_void(&wait_frame)},
        {"xrBeginFrame", as_void(&begin_frame)},
        {"xrEndFrame", as_void(&end_frame)},
        {"xrConvertTimeToTimespecTimeKHR", as_void(&to_timespec)},
        {"xrConvertTimespecTimeToTimeKHR", as_void(&from_timespec)},
    };
    const std::string_view text = name;
    if (mock().oldest() && (text.ends_with("KHR") || text.starts_with("xrEnumerateInstance"))) {
        *function = nullptr;
        return XR_ERROR_FUNCTION_UNSUPPORTED;
    }
    const auto found = kFunctions.find(text);
    *function = found != kFunctions.end() ? found->second : nullptr;
    return *function != nullptr ? XR_SUCCESS : XR_ERROR_FUNCTION_UNSUPPORTED;
}

XrResult make_instance(const XrInstanceCreateInfo* info, const XrApiLayerCreateInfo*,
                       XrInstance* instance) {
    const std::lock_guard lock(mock().mutex());
    if (mock().oldest() && info->enabledExtensionCount > 0) {
        return XR_ERROR_EXTENSION_NOT_PRESENT;
    }
    for (const char* const name :
         std::span(info->enabledExtensionNames, info->enabledExtensionCount)) {
        if (std::string_view(name) != XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME &&
            std::string_view(name) != XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME) {
            return XR_ERROR_EXTENSION_NOT_PRESENT;
        }
    }
    mock().add_instance();
    return make(instance);
}

}  // namespace

MockRuntime& MockRuntime::the() {
    static MockRuntime the_runtime;
    return the_runtime;
}

void MockRuntime::end_instance(std::uint64_t handle) {
    end(handle);
    if (--instances_ > 0) {
        return;
    }
    live_.clear();
    acquired_.clear();
    view_counts_.clear();
    failures_.clear();
    focused_ = true;
}

XrResult MockRuntime::create_through_layer(const std::vector<const char*>& wanted,
                                           XrInstance& instance) {
    return tests::create_through_layer({.extensions = wanted}, &get_proc, &make_instance, instance,
                                       layer_.create_instance);
}

PFN_xrVoidFunction MockRuntime::find_through_layer(XrInstance instance, const char* name) {
    PFN_xrVoidFunction function = nullptr;
    the().layer_.get_instance_proc_addr(instance, name, &function);
    return function;
}

XrTime MockRuntime::now() { return time::monotonic_ns(); }

XrResult MockRuntime::acquire(std::uint64_t swapchain, std::uint32_t& index) {
    Acquired& acquired = acquired_[swapchain];
    if (acquired.images == kImages) {
        return XR_ERROR_CALL_ORDER_INVALID;
    }
    index = acquired.next++ % kImages;
    ++acquired.images;
    return XR_SUCCESS;
}

XrResult MockRuntime::wait(std::uint64_t swapchain) {
    Acquired& acquired = acquired_[swapchain];
    if (acquired.images == 0 || acquired.waited) {
        return XR_ERROR_CALL_ORDER_INVALID;
    }
    acquired.waited = true;
    return XR_SUCCESS;
}

XrResult MockRuntime::release(std::uint64_t swapchain) {
    Acquired& acquired = acquired_[swapchain];
    if (!acquired.waited) {
        return XR_ERROR_CALL_ORDER_INVALID;
    }
    acquired.waited = false;
    --acquired.images;
    return XR_SUCCESS;
}

std::uint32_t MockRuntime::acquired_images() const {
    std::uint32_t images = 0;
    for (const auto& [swapchain, acquired] : acquired_) {
        images += acquired.images;
    }
    return images;
}

void MockRuntime::see_layers(const XrFrameEndInfo& info) {
    view_counts_.clear();
    for (const XrCompositionLayerBaseHeader* const layer :
         std::span(info.layers, info.layers != nullptr ? info.layerCount : 0)) {
        if (layer->type == XR_TYPE_COMPOSITION_LAYER_PROJECTION) {
            view_counts_.push_back(
                reinterpret_cast<const XrCompositionLayerProjection*>(layer)->viewCount);
        }
    }
}

XrResult MockRuntime::failure_of(const char* function) {
    const auto found = failures_.find(std::string_view(function));
    if (found == failures_.end()) {
        return XR_SUCCESS;
    }
    const XrResult result = found->second;
    failures_.erase(found);
    return result;
}

XrPath MockRuntime::path_of(const std::string& text) {
    return paths_.try_emplace(text, paths_.size() + 1).first->second;
}

bool MockRuntime::is_of_eyes(XrPath path) const {
    return std::ranges::any_of(paths_, [path](const auto& one) {
        return one.second == path && one.first.find("eye") != std::string::npos;
    });
}

}  // namespace gazeloop::openxr_layer
