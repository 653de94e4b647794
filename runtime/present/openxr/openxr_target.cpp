#include "runtime/present/openxr/openxr_target.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <optional>

#include "runtime/error.h"
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
          patience_ns_(static_cast<std::int64_t>(options.patience_s * 1e9)),
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
    [[nodiscard]] openxr::Session& session() override { return *session_; }

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
        take_display_time(state.predictedDisplayTime, frame);
        const AnnouncedPeriod::Judgement period = period_.next(state.predictedDisplayPeriod);
        tell(period.change);
        frame.period_ns = period.period_ns;
        frame.should_render = state.shouldRender == XR_TRUE;
    }

    void begin_frame() override {
        const auto begin = typed<XrFrameBeginInfo>(XR_TYPE_FRAME_BEGIN_INFO);
        if (xr_check_session(xrBeginFrame(session_->handle(), &begin), "xrBeginFrame") ==
            XR_FRAME_DISCARDED) {
            session_->tell(frame::kFrameDiscardedEvent, "frame discarded by the runtime");
        }
    }

    void locate(TargetFrame& frame) override {
        views_->locate(display_time_, display_time_is_good_);
        frame.views = views_->views();
        frame.hidden = hidden_;
        frame.head = views_->head();
        frame.new_origins = session_->take_new_origins();
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
        const XrResult ended = xrEndFrame(session_->handle(), &end);
        if (ended == XR_ERROR_TIME_INVALID && !display_time_is_good_) {
            session_->tell(frame::kFrameRefusedEvent,
                           "the runtime refused a frame for its own odd display time: not shown");
            be_patient(time::monotonic_ns());
            return;
        }
        xr_check_session(ended, "xrEndFrame");
        if (announced_a_time_) {
            no_time_since_ns_.reset();
        }
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

    std::vector<frame::Event> take_events() override { return session_->take_events(); }

  private:
    /// What the runtime announced goes back to it, odd or not: it knows what it meant. In place of
    /// what is no time at all it gets the likeliest.
    void take_display_time(XrTime announced, TargetFrame& frame) {
        const auto display_ns = announced > 0 ? clock_.host_ns(announced) : std::nullopt;
        const std::int64_t now_ns = time::monotonic_ns();
        const AnnouncedTime::Judgement judged = announced_.next(announced, display_ns, now_ns);
        tell(judged.change);
        announced_a_time_ = display_ns.has_value();
        if (!announced_a_time_) {
            be_patient(now_ns);
        }
        display_time_is_good_ = judged.good;
        display_time_ = announced_a_time_
                            ? announced
                            : clock_.xr_time(judged.likely_ns).value_or(display_time_ + 1);
        frame.display =
            judged.good ? time::Stamp{*display_ns, time::StampKind::Predicted} : time::Stamp{};
        frame.aimed_ns = judged.likely_ns;
    }

    /// Counts from the first of the frames in a row that have no display time that the runtime and
    /// we agree on. Far times may go on: their frames are shown, only when is unknown.
    void be_patient(std::int64_t now_ns) {
        no_time_since_ns_ = no_time_since_ns_.value_or(now_ns);
        const std::int64_t without_ns = now_ns - *no_time_since_ns_;
        if (without_ns >= patience_ns_) {
            throw SetupError(
                ErrorKind::SessionLost,
                fmt::format("OpenXR: {} has announced no display time that is one for {:.1f} s "
                            "(openxr.patience_s = {:g}): see that the headset is connected, then "
                            "start again",
                            instance_.runtime_name(), static_cast<double>(without_ns) * 1e-9,
                            static_cast<double>(patience_ns_) * 1e-9));
        }
    }

    void tell(const std::optional<frame::Event>& event) {
        if (event) {
            session_->tell(event->kind, event->text);
        }
    }

    std::string display_;
    std::int64_t patience_ns_;
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
    XrTime display_time_ = 0;  ///< what the frame that is under way is for, to the runtime
    bool display_time_is_good_ = true;
    bool announced_a_time_ = true;
    std::optional<std::int64_t> no_time_since_ns_;
    AnnouncedTime announced_;
    AnnouncedPeriod period_;
};

}  // namespace

std::unique_ptr<OpenXrTarget> make_openxr_target(const OpenXrOptions& options) {
    return std::make_unique<SessionTarget>(options);
}

}  // namespace gazeloop::present
