#include "runtime/present/openxr/openxr_target.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <optional>
#include <thread>

#include "runtime/error.h"
#include "runtime/latency/clock.h"
#include "runtime/present/openxr/openxr_swapchain.h"
#include "runtime/present/openxr/required_extensions.h"
#include "runtime/present/openxr/runtime_choice.h"
#include "runtime/present/openxr/visibility_mask.h"
#include "runtime/present/openxr/xr_check.h"

namespace gazeloop::present {
namespace {

constexpr XrViewConfigurationType kStereo = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
constexpr const char* kCoreValidationLayer = "XR_APILAYER_LUNARG_core_validation";
constexpr auto kIdleWait = std::chrono::milliseconds(5);
constexpr int kPollsBeforeWarning = 1000;  // 5 s
constexpr auto kPatienceAtExit = std::chrono::seconds(5);
constexpr std::int64_t kFarFromNowNs = 10'000'000'000;
constexpr XrDuration kLongestPeriodNs = 1'000'000'000;

std::string_view state_name(XrSessionState state) {
    constexpr std::array<std::string_view, 9> kNames{"UNKNOWN",      "IDLE",         "READY",
                                                     "SYNCHRONIZED", "VISIBLE",      "FOCUSED",
                                                     "STOPPING",     "LOSS_PENDING", "EXITING"};
    const auto index = static_cast<std::size_t>(state);
    return index < kNames.size() ? kNames[index] : "?";
}

template <typename T, typename Enumerate>
std::vector<T> enumerate(const T& blank, const char* what, Enumerate&& call) {
    std::uint32_t count = 0;
    xr_check(call(0, &count, nullptr), what);
    std::vector<T> items(count, blank);
    if (count > 0) {
        xr_check(call(count, &count, items.data()), what);
    }
    items.resize(count);
    return items;
}

/// Instance and system; also the factory of the Vulkan objects the runtime asks for.
class OpenXrInstance final : public render::VulkanFactory {
  public:
    OpenXrInstance(const RuntimeChoice& choice, const OpenXrOptions& options) {
        const auto& required = kRequiredXrExtensions;
        const auto offered = enumerate(
            typed<XrExtensionProperties>(XR_TYPE_EXTENSION_PROPERTIES),
            "the OpenXR runtime could not be loaded; check XR_RUNTIME_JSON, run ./dev setup to "
            "build Monado, or use --target headless",
            [](auto... a) { return xrEnumerateInstanceExtensionProperties(nullptr, a...); });
        const auto offers = [&offered](const char* name) {
            return std::ranges::any_of(offered, [name](const XrExtensionProperties& extension) {
                return std::strcmp(extension.extensionName, name) == 0;
            });
        };
        for (const char* name : required) {
            if (!offers(name)) {
                throw SetupError(ExitCode::NoDevice,
                                 fmt::format("the OpenXR runtime {} lacks {}: use another runtime "
                                             "(XR_RUNTIME_JSON) or --target headless",
                                             choice.manifest, name));
            }
        }
        auto info = typed<XrInstanceCreateInfo>(XR_TYPE_INSTANCE_CREATE_INFO);
        std::strcpy(info.applicationInfo.applicationName, "gazeloop");
        std::strcpy(info.applicationInfo.engineName, "gazeloop");
        info.applicationInfo.applicationVersion = 1;
        info.applicationInfo.engineVersion = 1;
        info.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
        std::vector<const char*> enabled(required.begin(), required.end());
        has_visibility_mask_ = offers(XR_KHR_VISIBILITY_MASK_EXTENSION_NAME);
        if (has_visibility_mask_) {
            enabled.push_back(XR_KHR_VISIBILITY_MASK_EXTENSION_NAME);
        }
        takes_depth_ = options.depth && offers(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME);
        if (takes_depth_) {
            enabled.push_back(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME);
        }
        info.enabledExtensionCount = static_cast<std::uint32_t>(enabled.size());
        info.enabledExtensionNames = enabled.data();
        if (options.validation) {
            info.enabledApiLayerCount = 1;
            info.enabledApiLayerNames = &kCoreValidationLayer;
        }
        const XrResult created = xrCreateInstance(&info, &instance_);
        if (created == XR_ERROR_API_LAYER_NOT_PRESENT) {
            throw SetupError(ExitCode::NoDevice,
                             "target.validation is on, but its layer is not installed (Debian: "
                             "openxr-layer-corevalidation)");
        }
        // Whatever a runtime calls it, before there is an instance nothing can have been lost.
        if (XR_FAILED(created)) {
            throw SetupError(
                ExitCode::NoDevice,
                fmt::format("OpenXR: the runtime {} did not start ({}): is its service running, "
                            "and does Vulkan have a driver (vulkaninfo)? ./dev setup builds an "
                            "in-process Monado; --target headless needs no runtime",
                            choice.manifest, xr_name(created)));
        }
        auto properties = typed<XrInstanceProperties>(XR_TYPE_INSTANCE_PROPERTIES);
        xr_check(xrGetInstanceProperties(instance_, &properties), "xrGetInstanceProperties");
        runtime_name_ = fmt::format("{} {}.{}.{}", properties.runtimeName,
                                    XR_VERSION_MAJOR(properties.runtimeVersion),
                                    XR_VERSION_MINOR(properties.runtimeVersion),
                                    XR_VERSION_PATCH(properties.runtimeVersion));
        auto system = typed<XrSystemGetInfo>(XR_TYPE_SYSTEM_GET_INFO);
        system.formFactor = XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY;
        xr_check(xrGetSystem(instance_, &system, &system_),
                 fmt::format("{} has no head-mounted display now; connect one, or use --target "
                             "headless",
                             runtime_name_));
        auto system_properties = typed<XrSystemProperties>(XR_TYPE_SYSTEM_PROPERTIES);
        xr_check(xrGetSystemProperties(instance_, system_, &system_properties),
                 "xrGetSystemProperties");
        system_name_ = system_properties.systemName;
    }
    OpenXrInstance(const OpenXrInstance&) = delete;
    OpenXrInstance& operator=(const OpenXrInstance&) = delete;
    ~OpenXrInstance() override {
        if (instance_ != XR_NULL_HANDLE) {
            xrDestroyInstance(instance_);
        }
    }

    VkInstance create_instance(PFN_vkGetInstanceProcAddr get_proc,
                               const VkInstanceCreateInfo& info) override {
        auto requirements =
            typed<XrGraphicsRequirementsVulkan2KHR>(XR_TYPE_GRAPHICS_REQUIREMENTS_VULKAN2_KHR);
        xr_check(xr_function<PFN_xrGetVulkanGraphicsRequirements2KHR>(
                     instance_, "xrGetVulkanGraphicsRequirements2KHR")(instance_, system_,
                                                                       &requirements),
                 "xrGetVulkanGraphicsRequirements2KHR");
        auto create = typed<XrVulkanInstanceCreateInfoKHR>(XR_TYPE_VULKAN_INSTANCE_CREATE_INFO_KHR);
        create.systemId = system_;
        create.pfnGetInstanceProcAddr = get_proc;
        create.vulkanCreateInfo = &info;
        VkInstance instance = VK_NULL_HANDLE;
        VkResult vulkan = VK_SUCCESS;
        xr_check(xr_function<PFN_xrCreateVulkanInstanceKHR>(instance_, "xrCreateVulkanInstanceKHR")(
                     instance_, &create, &instance, &vulkan),
                 "xrCreateVulkanInstanceKHR");
        check_vulkan(vulkan, "a Vulkan instance");
        return instance;
    }
    VkPhysicalDevice choose_physical_device(VkInstance instance) override {
        auto get =
            typed<XrVulkanGraphicsDeviceGetInfoKHR>(XR_TYPE_VULKAN_GRAPHICS_DEVICE_GET_INFO_KHR);
        get.systemId = system_;
        get.vulkanInstance = instance;
        VkPhysicalDevice device = VK_NULL_HANDLE;
        xr_check(xr_function<PFN_xrGetVulkanGraphicsDevice2KHR>(
                     instance_, "xrGetVulkanGraphicsDevice2KHR")(instance_, &get, &device),
                 "xrGetVulkanGraphicsDevice2KHR");
        return device;
    }
    VkDevice create_device(PFN_vkGetInstanceProcAddr get_proc, VkPhysicalDevice physical,
                           const VkDeviceCreateInfo& info) override {
        auto create = typed<XrVulkanDeviceCreateInfoKHR>(XR_TYPE_VULKAN_DEVICE_CREATE_INFO_KHR);
        create.systemId = system_;
        create.pfnGetInstanceProcAddr = get_proc;
        create.vulkanPhysicalDevice = physical;
        create.vulkanCreateInfo = &info;
        VkDevice device = VK_NULL_HANDLE;
        VkResult vulkan = VK_SUCCESS;
        xr_check(xr_function<PFN_xrCreateVulkanDeviceKHR>(instance_, "xrCreateVulkanDeviceKHR")(
                     instance_, &create, &device, &vulkan),
                 "xrCreateVulkanDeviceKHR");
        check_vulkan(vulkan, "a Vulkan device");
        return device;
    }

    [[nodiscard]] XrInstance handle() const { return instance_; }
    [[nodiscard]] XrSystemId system() const { return system_; }
    [[nodiscard]] const std::string& runtime_name() const { return runtime_name_; }
    [[nodiscard]] const std::string& system_name() const { return system_name_; }
    [[nodiscard]] bool has_visibility_mask() const { return has_visibility_mask_; }
    [[nodiscard]] bool takes_depth() const { return takes_depth_; }

  private:
    void check_vulkan(VkResult result, std::string_view what) const {
        if (result != VK_SUCCESS) {
            throw SetupError(ExitCode::NoDevice,
                             fmt::format("{} could not create {} ({}): install a Vulkan 1.3 driver "
                                         "(Debian: mesa-vulkan-drivers); VK_ICD_FILENAMES, if set, "
                                         "must name an existing one",
                                         runtime_name_, what, vk::to_string(vk::Result{result})));
        }
    }

    XrInstance instance_ = XR_NULL_HANDLE;
    XrSystemId system_ = XR_NULL_SYSTEM_ID;
    std::string runtime_name_;
    std::string system_name_;
    bool has_visibility_mask_ = false;
    bool takes_depth_ = false;
};

class OpenXrTarget final : public FrameTarget {
  public:
    explicit OpenXrTarget(const OpenXrOptions& options)
        : options_(options),
          choice_(choose_runtime(options.display)),
          instance_(choice_, options),
          to_timespec_(xr_function<PFN_xrConvertTimeToTimespecTimeKHR>(
              instance_.handle(), "xrConvertTimeToTimespecTimeKHR")),
          from_timespec_(xr_function<PFN_xrConvertTimespecTimeToTimeKHR>(
              instance_.handle(), "xrConvertTimespecTimeToTimeKHR")) {
        spdlog::info("OpenXR runtime: {} ({}: {})", instance_.runtime_name(), choice_.reason,
                     choice_.manifest);
        const auto sizes =
            enumerate(typed<XrViewConfigurationView>(XR_TYPE_VIEW_CONFIGURATION_VIEW),
                      "xrEnumerateViewConfigurationViews", [&](auto... a) {
                          return xrEnumerateViewConfigurationViews(
                              instance_.handle(), instance_.system(), kStereo, a...);
                      });
        if (sizes.size() != gaze::kEyeCount) {
            throw SetupError(ExitCode::NoDevice,
                             fmt::format("{} offers {} views for stereo, 2 are needed",
                                         instance_.runtime_name(), sizes.size()));
        }
        for (const gaze::Eye eye : gaze::kEyes) {
            const XrViewConfigurationView& size = sizes[gaze::index(eye)];
            const auto scaled = [&](std::uint32_t side, std::uint32_t most) {
                return std::clamp(static_cast<std::uint32_t>(std::lround(side * options.scale)), 2U,
                                  most);
            };
            extents_[gaze::index(eye)] =
                vk::Extent2D(scaled(size.recommendedImageRectWidth, size.maxImageRectWidth),
                             scaled(size.recommendedImageRectHeight, size.maxImageRectHeight));
        }
    }

    OpenXrTarget(const OpenXrTarget&) = delete;
    OpenXrTarget& operator=(const OpenXrTarget&) = delete;
    ~OpenXrTarget() override {
        depth_swapchains_.clear();
        swapchains_.clear();
        for (const XrSpace space : {view_space_, local_space_}) {
            if (space != XR_NULL_HANDLE) {
                xrDestroySpace(space);
            }
        }
        if (session_ != XR_NULL_HANDLE) {
            xrDestroySession(session_);
        }
    }

    render::VulkanFactory* vulkan_factory() override { return &instance_; }

    void start(const render::VulkanContext& context) override {
        auto binding = typed<XrGraphicsBindingVulkan2KHR>(XR_TYPE_GRAPHICS_BINDING_VULKAN2_KHR);
        binding.instance = *context.instance();
        binding.physicalDevice = *context.physical();
        binding.device = *context.device();
        binding.queueFamilyIndex = context.queue_family();
        binding.queueIndex = 0;
        auto info = typed<XrSessionCreateInfo>(XR_TYPE_SESSION_CREATE_INFO);
        info.next = &binding;
        info.systemId = instance_.system();
        xr_check(xrCreateSession(instance_.handle(), &info, &session_), "xrCreateSession");
        local_space_ = make_space(XR_REFERENCE_SPACE_TYPE_LOCAL);
        view_space_ = make_space(XR_REFERENCE_SPACE_TYPE_VIEW);
        if (instance_.has_visibility_mask()) {
            visibility_mask_.emplace(instance_.handle());
            hidden_ = visibility_mask_->query(session_, kStereo);
        }
        choose_formats();
        for (const gaze::Eye eye : gaze::kEyes) {
            const vk::Extent2D extent = extents_[gaze::index(eye)];
            swapchains_.emplace_back(context, session_, extent, format_, SwapchainContent::Color);
            if (depth_format_) {
                depth_swapchains_.emplace_back(context, session_, extent, *depth_format_,
                                               SwapchainContent::Depth);
            }
        }
    }

    [[nodiscard]] gaze::PerEye<vk::Extent2D> extents() const override { return extents_; }
    [[nodiscard]] vk::Format format() const override { return format_; }
    [[nodiscard]] std::optional<vk::Format> depth_format() const override { return depth_format_; }

    TargetState poll() override {
        auto event = typed<XrEventDataBuffer>(XR_TYPE_EVENT_DATA_BUFFER);
        while (xr_check_session(xrPollEvent(instance_.handle(), &event), "xrPollEvent") ==
               XR_SUCCESS) {
            handle(event);
            event = typed<XrEventDataBuffer>(XR_TYPE_EVENT_DATA_BUFFER);
        }
        if (ended_) {
            return TargetState::Ended;
        }
        if (!session_running_) {
            if (exit_requested_ && !exit_sent_) {
                return TargetState::Ended;  // no session runs that could be asked to end
            }
            if (++idle_polls_ == kPollsBeforeWarning) {
                spdlog::warn("{} wants no frames (yet): waiting; Ctrl-C ends",
                             instance_.runtime_name());
            }
            std::this_thread::sleep_for(kIdleWait);
            return TargetState::Idle;
        }
        idle_polls_ = 0;
        if (exit_sent_ && std::chrono::steady_clock::now() > exit_deadline_) {
            events_.emplace_back("the runtime does not end the session: it was left");
            spdlog::warn("{} does not end the session, which it was asked to: leaving it",
                         instance_.runtime_name());
            return TargetState::Ended;
        }
        return TargetState::Running;
    }

    void wait_frame(TargetFrame& frame) override {
        const auto wait = typed<XrFrameWaitInfo>(XR_TYPE_FRAME_WAIT_INFO);
        auto state = typed<XrFrameState>(XR_TYPE_FRAME_STATE);
        xr_check_session(xrWaitFrame(session_, &wait, &state), "xrWaitFrame");
        display_time_ = state.predictedDisplayTime;
        frame.display = {to_host_ns(state.predictedDisplayTime), latency::StampKind::Predicted};
        // Some runtimes know no period at first; 0 says so.
        const XrDuration period = state.predictedDisplayPeriod;
        frame.period_ns = period > 0 && period <= kLongestPeriodNs ? period : 0;
        frame.should_render = state.shouldRender == XR_TRUE;
        watch_display_time(frame.display.ns);
    }

    void begin_frame() override {
        const auto begin = typed<XrFrameBeginInfo>(XR_TYPE_FRAME_BEGIN_INFO);
        if (xr_check_session(xrBeginFrame(session_, &begin), "xrBeginFrame") ==
            XR_FRAME_DISCARDED) {
            events_.emplace_back("frame discarded by the runtime");
        }
    }

    void locate(TargetFrame& frame) override {
        auto info = typed<XrViewLocateInfo>(XR_TYPE_VIEW_LOCATE_INFO);
        info.viewConfigurationType = kStereo;
        info.displayTime = display_time_;
        info.space = local_space_;
        auto state = typed<XrViewState>(XR_TYPE_VIEW_STATE);
        std::array<XrView, gaze::kEyeCount> views{typed<XrView>(XR_TYPE_VIEW),
                                                  typed<XrView>(XR_TYPE_VIEW)};
        std::uint32_t count = 0;
        xr_check_session(xrLocateViews(session_, &info, &state, views.size(), &count, views.data()),
                         "xrLocateViews");
        bool tracked = true;
        bool rendered_for = true;
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            // While tracking is lost the last known pose stands.
            const auto pose = from_xr(views[e].pose);
            if (pose && (state.viewStateFlags & XR_VIEW_STATE_ORIENTATION_VALID_BIT) != 0) {
                views_[e].pose.orientation = pose->orientation;
            } else {
                tracked = false;
            }
            if (pose && (state.viewStateFlags & XR_VIEW_STATE_POSITION_VALID_BIT) != 0) {
                views_[e].pose.position_m = pose->position_m;
            } else {
                tracked = false;
            }
            rendered_for = take_field_of_view(e, views[e].fov) && rendered_for;
        }
        say_change(tracked, tracked_, "the head is tracked",
                   "the head is not tracked: its last known pose stands");
        say_change(rendered_for, rendered_for_, "the fields of view can be rendered for",
                   "a field of view that nothing can be rendered for: the last one stands");
        if (const auto head = locate_head(display_time_)) {
            head_ = *head;
        }
        frame.views = views_;
        frame.hidden = hidden_;
        frame.head = head_;
    }

    gaze::PerEye<render::EyeTarget> acquire() override {
        gaze::PerEye<render::EyeTarget> targets;
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            const OpenXrSwapchain::Image color = swapchains_[e].acquire();
            targets[e] = {color.image, color.view};
            if (depth_format_) {
                const OpenXrSwapchain::Image depth = depth_swapchains_[e].acquire();
                targets[e].depth_image = depth.image;
                targets[e].depth_view = depth.view;
            }
        }
        return targets;
    }

    void end_frame(const TargetFrame& frame, bool rendered) override {
        std::array<XrCompositionLayerProjectionView, gaze::kEyeCount> layer_views{};
        std::array<XrCompositionLayerDepthInfoKHR, gaze::kEyeCount> layer_depths{};
        auto layer = typed<XrCompositionLayerProjection>(XR_TYPE_COMPOSITION_LAYER_PROJECTION);
        const XrCompositionLayerBaseHeader* const layers[] = {
            reinterpret_cast<const XrCompositionLayerBaseHeader*>(&layer)};
        if (rendered) {
            for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
                swapchains_[e].release();
                const gaze::EyeView& view = frame.views[e];
                layer_views[e].type = XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW;
                layer_views[e].pose = to_xr(view.pose);
                layer_views[e].fov = {
                    static_cast<float>(view.fov.left_rad), static_cast<float>(view.fov.right_rad),
                    static_cast<float>(view.fov.up_rad), static_cast<float>(view.fov.down_rad)};
                layer_views[e].subImage = swapchains_[e].sub_image();
                if (!depth_format_) {
                    continue;
                }
                depth_swapchains_[e].release();
                if (frame.depth) {
                    layer_depths[e].type = XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR;
                    layer_depths[e].subImage = depth_swapchains_[e].sub_image();
                    layer_depths[e].maxDepth = 1.0F;
                    layer_depths[e].nearZ = frame.depth->near_m;
                    layer_depths[e].farZ = frame.depth->far_m;
                    layer_views[e].next = &layer_depths[e];
                }
            }
            layer.space = local_space_;
            layer.viewCount = static_cast<std::uint32_t>(layer_views.size());
            layer.views = layer_views.data();
        }
        auto end = typed<XrFrameEndInfo>(XR_TYPE_FRAME_END_INFO);
        end.displayTime = display_time_;
        end.environmentBlendMode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
        end.layerCount = rendered ? 1 : 0;
        end.layers = rendered ? layers : nullptr;
        xr_check_session(xrEndFrame(session_, &end), "xrEndFrame");
    }

    std::optional<gaze::Pose> head_at(std::int64_t time_ns) override {
        const timespec time{time_ns / 1'000'000'000, time_ns % 1'000'000'000};
        XrTime xr_time = 0;
        if (time_ns <= 0 || XR_FAILED(from_timespec_(instance_.handle(), &time, &xr_time)) ||
            xr_time <= 0) {
            return std::nullopt;
        }
        return locate_head(xr_time);
    }

    void request_exit() override {
        exit_requested_ = true;
        if (session_running_ && !exit_sent_) {
            xr_check_session(xrRequestExitSession(session_), "xrRequestExitSession");
            exit_sent_ = true;
            exit_deadline_ = std::chrono::steady_clock::now() + kPatienceAtExit;
        }
    }

    [[nodiscard]] std::vector<std::pair<std::string, std::string>> properties() const override {
        return {{"target", "openxr"},
                {"display", options_.display.name},
                {"openxr runtime", instance_.runtime_name()},
                {"openxr system", instance_.system_name()},
                {"openxr manifest", choice_.manifest},
                {"openxr runtime chosen by", choice_.reason},
                {"target format", vk::to_string(format_)},
                {"depth layer", depth_format_ ? vk::to_string(*depth_format_) : "none"}};
    }

    std::vector<std::string> take_events() override { return std::exchange(events_, {}); }

  private:
    /// False if it cannot be rendered for, in which case the last one stands.
    bool take_field_of_view(std::size_t eye, const XrFovf& fov) {
        gaze::EyeView view = views_[eye];
        view.fov = {fov.angleLeft, fov.angleRight, fov.angleUp, fov.angleDown};
        view.width_px = extents_[eye].width;
        view.height_px = extents_[eye].height;
        if (gaze::is_valid(view)) {
            views_[eye] = view;
            return true;
        }
        if (!gaze::is_valid(views_[eye])) {
            throw SetupError(ExitCode::NoDevice,
                             fmt::format("{} gives the {} eye a field of view that nothing can be "
                                         "rendered for; use another runtime or --target headless",
                                         instance_.runtime_name(), gaze::kEyeNames[eye]));
        }
        return false;
    }

    void say_change(bool now, bool& before, const char* good, const char* bad) {
        if (now != before) {
            events_.emplace_back(now ? good : bad);
        }
        before = now;
    }

    /// Announced times should grow, and lie a few periods ahead. They are used as they are.
    void watch_display_time(std::int64_t display_ns) {
        if (display_before_ns_ && display_ns <= *display_before_ns_) {
            events_.push_back(
                fmt::format("the announced display time went back by {:.3f} ms",
                            static_cast<double>(*display_before_ns_ - display_ns) * 1e-6));
        }
        display_before_ns_ = display_ns;
        const std::int64_t ahead_ns = display_ns - latency::monotonic_ns();
        const bool near = std::abs(ahead_ns) < kFarFromNowNs;
        if (!near && display_near_) {
            events_.push_back(fmt::format("the announced display time lies {:.3f} s {}",
                                          std::abs(static_cast<double>(ahead_ns)) * 1e-9,
                                          ahead_ns > 0 ? "ahead" : "back"));
        }
        display_near_ = near;
    }

    XrSpace make_space(XrReferenceSpaceType type) {
        auto info = typed<XrReferenceSpaceCreateInfo>(XR_TYPE_REFERENCE_SPACE_CREATE_INFO);
        info.referenceSpaceType = type;
        info.poseInReferenceSpace = to_xr({});
        XrSpace space = XR_NULL_HANDLE;
        xr_check(xrCreateReferenceSpace(session_, &info, &space), "xrCreateReferenceSpace");
        return space;
    }

    /// Formats that encode sRGB by themselves first; among them the runtime's preference. Of depth,
    /// the most exact one that has no stencil.
    void choose_formats() {
        const auto formats =
            enumerate(std::int64_t{0}, "xrEnumerateSwapchainFormats",
                      [&](auto... a) { return xrEnumerateSwapchainFormats(session_, a...); });
        for (const vk::Format wanted : {vk::Format::eD16Unorm, vk::Format::eD32Sfloat}) {
            if (instance_.takes_depth() &&
                std::ranges::find(formats, static_cast<std::int64_t>(wanted)) != formats.end()) {
                depth_format_ = wanted;
            }
        }
        for (const auto& wanted :
             {std::array{vk::Format::eR8G8B8A8Srgb, vk::Format::eB8G8R8A8Srgb},
              std::array{vk::Format::eR8G8B8A8Unorm, vk::Format::eB8G8R8A8Unorm}}) {
            for (const std::int64_t format : formats) {
                if (std::ranges::find(wanted, static_cast<vk::Format>(format)) != wanted.end()) {
                    format_ = static_cast<vk::Format>(format);
                    return;
                }
            }
        }
        throw SetupError(
            ExitCode::NoDevice,
            fmt::format("{} offers no 8-bit RGBA swapchain format; use another runtime "
                        "or --target headless",
                        instance_.runtime_name()));
    }

    void handle(const XrEventDataBuffer& event) {
        if (event.type == XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING) {
            throw SetupError(ExitCode::SessionLost,
                             fmt::format("OpenXR: {} is going away (instance loss pending): start "
                                         "again when it is back",
                                         instance_.runtime_name()));
        }
        if (event.type == XR_TYPE_EVENT_DATA_EVENTS_LOST) {
            events_.emplace_back("OpenXR events were lost");
        }
        if (event.type == XR_TYPE_EVENT_DATA_VISIBILITY_MASK_CHANGED_KHR && visibility_mask_) {
            hidden_ = visibility_mask_->query(session_, kStereo);
            events_.emplace_back("visibility mask changed");
        }
        if (event.type != XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED) {
            return;
        }
        XrEventDataSessionStateChanged changed{};
        std::memcpy(&changed, &event, sizeof changed);
        events_.push_back(fmt::format("session state: {}", state_name(changed.state)));
        switch (changed.state) {
            case XR_SESSION_STATE_READY: {
                if (exit_requested_) {
                    break;
                }
                auto begin = typed<XrSessionBeginInfo>(XR_TYPE_SESSION_BEGIN_INFO);
                begin.primaryViewConfigurationType = kStereo;
                xr_check_session(xrBeginSession(session_, &begin), "xrBeginSession");
                session_running_ = true;
                break;
            }
            case XR_SESSION_STATE_STOPPING:
                session_running_ = false;
                xr_check_session(xrEndSession(session_), "xrEndSession");
                break;
            case XR_SESSION_STATE_EXITING:
                ended_ = true;
                break;
            case XR_SESSION_STATE_LOSS_PENDING:
                throw SetupError(ExitCode::SessionLost,
                                 fmt::format("OpenXR: {} is losing the session (session loss "
                                             "pending): see that the headset is connected, then "
                                             "start again",
                                             instance_.runtime_name()));
            default:
                break;
        }
    }

    std::optional<gaze::Pose> locate_head(XrTime time) const {
        auto location = typed<XrSpaceLocation>(XR_TYPE_SPACE_LOCATION);
        const XrResult result = xrLocateSpace(view_space_, local_space_, time, &location);
        if (result == XR_ERROR_TIME_INVALID) {
            return std::nullopt;  // so long ago that the runtime does not know any more
        }
        xr_check_session(result, "xrLocateSpace");
        constexpr XrSpaceLocationFlags kNeeded =
            XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT;
        if ((location.locationFlags & kNeeded) != kNeeded) {
            return std::nullopt;
        }
        return from_xr(location.pose);
    }

    [[nodiscard]] std::int64_t to_host_ns(XrTime time) const {
        timespec host{};
        xr_check_session(to_timespec_(instance_.handle(), time, &host),
                         "the announced display time is none: xrConvertTimeToTimespecTimeKHR");
        return std::int64_t{host.tv_sec} * 1'000'000'000 + host.tv_nsec;
    }

    OpenXrOptions options_;
    RuntimeChoice choice_;
    OpenXrInstance instance_;
    PFN_xrConvertTimeToTimespecTimeKHR to_timespec_ = nullptr;
    PFN_xrConvertTimespecTimeToTimeKHR from_timespec_ = nullptr;
    XrSession session_ = XR_NULL_HANDLE;
    XrSpace local_space_ = XR_NULL_HANDLE;
    XrSpace view_space_ = XR_NULL_HANDLE;
    gaze::PerEye<vk::Extent2D> extents_;
    vk::Format format_ = vk::Format::eUndefined;
    std::vector<OpenXrSwapchain> swapchains_;
    std::optional<vk::Format> depth_format_;
    std::vector<OpenXrSwapchain> depth_swapchains_;  ///< none without a depth format
    XrTime display_time_ = 0;
    gaze::Pose head_;
    gaze::StereoView views_;
    std::optional<VisibilityMask> visibility_mask_;
    gaze::HiddenMeshes hidden_;
    bool tracked_ = true;
    bool rendered_for_ = true;
    std::optional<std::int64_t> display_before_ns_;
    bool display_near_ = true;
    std::vector<std::string> events_;
    bool session_running_ = false;
    bool exit_requested_ = false;
    bool exit_sent_ = false;
    std::chrono::steady_clock::time_point exit_deadline_;
    int idle_polls_ = 0;
    bool ended_ = false;
};

}  // namespace

std::unique_ptr<FrameTarget> make_openxr_target(const OpenXrOptions& options) {
    return std::make_unique<OpenXrTarget>(options);
}

}  // namespace gazeloop::present
