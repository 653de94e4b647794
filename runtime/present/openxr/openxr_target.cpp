#include "runtime/present/openxr/openxr_target.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <optional>

#include "runtime/openxr/enumerate.h"
#include "runtime/openxr/instance.h"
#include "runtime/openxr/runtime_choice.h"
#include "runtime/openxr/vulkan_objects.h"
#include "runtime/openxr/xr_clock.h"
#include "runtime/present/openxr/announced_time.h"
#include "runtime/present/openxr/openxr_pictures.h"
#include "runtime/present/openxr/openxr_views.h"
#include "runtime/present/openxr/visibility_mask.h"
#include "runtime/time/clock.h"

namespace gazeloop::present {
namespace {

using openxr::typed;
using openxr::xr_check_session;

constexpr XrDuration kLongestPeriodNs = 1'000'000'000;

openxr::InstanceOptions instance_options(const OpenXrOptions& options) {
    openxr::InstanceOptions instance{.validation = options.validation,
                                     .wanted = options.extensions};
    instance.wanted.push_back(XR_KHR_VISIBILITY_MASK_EXTENSION_NAME);
    if (options.depth) {
        instance.wanted.push_back(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME);
    }
    return instance;
}

/// Opaque where the display can be, else what the runtime prefers (see-through displays).
XrEnvironmentBlendMode blend_mode_of(const openxr::Instance& instance) {
    const auto offered = openxr::enumerate<XrEnvironmentBlendMode>(
        XR_ENVIRONMENT_BLEND_MODE_OPAQUE, "xrEnumerateEnvironmentBlendModes",
        [&](std::uint32_t capacity, std::uint32_t* count, XrEnvironmentBlendMode* modes) {
            return xrEnumerateEnvironmentBlendModes(instance.handle(), instance.system(),
                                                    openxr::kStereo, capacity, count, modes);
        });
    return offered.empty() ||
                   std::ranges::find(offered, XR_ENVIRONMENT_BLEND_MODE_OPAQUE) != offered.end()
               ? XR_ENVIRONMENT_BLEND_MODE_OPAQUE
               : offered.front();
}

class SessionTarget final : public OpenXrTarget {
  public:
    explicit SessionTarget(const OpenXrOptions& options)
        : display_(options.display.name),
          choice_(openxr::choose_runtime(options.display)),
          instance_(choice_, instance_options(options)),
          vulkan_(instance_),
          clock_(instance_),
          extents_(picture_extents(instance_, options.scale)),
          blend_mode_(blend_mode_of(instance_)) {
        spdlog::info("OpenXR runtime: {} ({}: {})", instance_.runtime_name(), choice_.reason,
                     choice_.manifest);
    }

    vulkan::Factory* vulkan_factory() override { return &vulkan_; }

    void start(const vulkan::Context& context) override {
        session_.emplace(instance_, clock_, context);
        views_.emplace(*session_, extents_);
        if (instance_.has(XR_KHR_VISIBILITY_MASK_EXTENSION_NAME)) {
            visibility_mask_.emplace(instance_.handle());
            hidden_ = visibility_mask_->query(session_->handle(), openxr::kStereo);
        }
        pictures_.emplace(context, *session_, extents_,
                          instance_.has(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME));
    }

    [[nodiscard]] const openxr::Instance& instance() const override { return instance_; }
    [[nodiscard]] const openxr::Session& session() const override { return *session_; }

    [[nodiscard]] gaze::PerEye<vk::Extent2D> extents() const override { return extents_; }
    [[nodiscard]] vk::Format format() const override { return pictures_->format(); }
    [[nodiscard]] std::optional<vk::Format> depth_format() const override {
        return pictures_->depth_format();
    }

    TargetState poll() override {
        const openxr::Session::Activity activity = session_->poll();
        if (visibility_mask_ &&
            std::exchange(mask_changes_, session_->mask_changes()) != session_->mask_changes()) {
            hidden_ = visibility_mask_->query(session_->handle(), openxr::kStereo);
        }
        switch (activity) {
            case openxr::Session::Activity::Running:
                return TargetState::Running;
            case openxr::Session::Activity::Idle:
                return TargetState::Idle;
            case openxr::Session::Activity::Ended:
                break;
        }
        return TargetState::Ended;
    }

    void wait_frame(TargetFrame& frame) override {
        const auto wait = typed<XrFrameWaitInfo>(XR_TYPE_FRAME_WAIT_INFO);
        auto state = typed<XrFrameState>(XR_TYPE_FRAME_STATE);
        xr_check_session(xrWaitFrame(session_->handle(), &wait, &state), "xrWaitFrame");
        display_time_ = state.predictedDisplayTime;
        const auto display_ns = clock_.host_ns(display_time_);
        xr_check_session(display_ns ? XR_SUCCESS : XR_ERROR_TIME_INVALID,
                         "the announced display time is none: xrConvertTimeToTimespecTimeKHR");
        frame.display = {*display_ns, time::StampKind::Predicted};
        // Some runtimes know no period at first; 0 says so.
        const XrDuration period = state.predictedDisplayPeriod;
        frame.period_ns = period > 0 && period <= kLongestPeriodNs ? period : 0;
        frame.should_render = state.shouldRender == XR_TRUE;
        if (const auto odd = announced_.next(*display_ns, time::monotonic_ns())) {
            session_->tell(*odd);
        }
    }

    void begin_frame() override {
        const auto begin = typed<XrFrameBeginInfo>(XR_TYPE_FRAME_BEGIN_INFO);
        if (xr_check_session(xrBeginFrame(session_->handle(), &begin), "xrBeginFrame") ==
            XR_FRAME_DISCARDED) {
            session_->tell("frame discarded by the runtime");
        }
    }

    void locate(TargetFrame& frame) override {
        views_->locate(display_time_);
        frame.views = views_->views();
        frame.hidden = hidden_;
        frame.head = views_->head();
    }

    gaze::PerEye<render::EyeTarget> acquire() override { return pictures_->acquire(); }

    void end_frame(const TargetFrame& frame, bool rendered) override {
        const XrCompositionLayerBaseHeader* layer = nullptr;
        if (rendered) {
            pictures_->release();
            layer = pictures_->layer(frame, session_->local_space());
        }
        auto end = typed<XrFrameEndInfo>(XR_TYPE_FRAME_END_INFO);
        end.displayTime = display_time_;
        end.environmentBlendMode = blend_mode_;
        end.layerCount = rendered ? 1 : 0;
        end.layers = rendered ? &layer : nullptr;
        xr_check_session(xrEndFrame(session_->handle(), &end), "xrEndFrame");
    }

    std::optional<gaze::Pose> head_at(std::int64_t time_ns) override {
        const auto time = clock_.xr_time(time_ns);
        return time ? session_->head_at(*time) : std::nullopt;
    }

    void request_exit() override { session_->request_exit(); }

    [[nodiscard]] std::vector<std::pair<std::string, std::string>> properties() const override {
        return {{"target", "openxr"},
                {"display", display_},
                {"openxr runtime", instance_.runtime_name()},
                {"openxr system", instance_.system_name()},
                {"openxr manifest", choice_.manifest},
                {"openxr runtime chosen by", choice_.reason},
                {"target format", vk::to_string(format())},
                {"depth layer", depth_format() ? vk::to_string(*depth_format()) : "none"}};
    }

    std::vector<std::string> take_events() override { return session_->take_events(); }

  private:
    std::string display_;
    openxr::RuntimeChoice choice_;
    openxr::Instance instance_;
    openxr::VulkanObjects vulkan_;
    openxr::XrClock clock_;
    gaze::PerEye<vk::Extent2D> extents_;
    XrEnvironmentBlendMode blend_mode_;
    std::optional<openxr::Session> session_;
    std::optional<OpenXrViews> views_;
    std::optional<OpenXrPictures> pictures_;  // swapchains go before the session
    std::optional<VisibilityMask> visibility_mask_;
    std::uint64_t mask_changes_ = 0;
    gaze::HiddenMeshes hidden_;
    XrTime display_time_ = 0;
    AnnouncedTime announced_;
};

}  // namespace

std::unique_ptr<OpenXrTarget> make_openxr_target(const OpenXrOptions& options) {
    return std::make_unique<SessionTarget>(options);
}

}  // namespace gazeloop::present
