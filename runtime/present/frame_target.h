#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

#include "runtime/frame/event.h"
#include "runtime/gaze/hidden_mesh.h"
#include "runtime/gaze/origin_change.h"
#include "runtime/gaze/view.h"
#include "runtime/render/eye_target.h"
#include "runtime/time/stamp.h"
#include "runtime/vulkan/context.h"

namespace gazeloop::present {

/// What the depth images of a frame mean: the distances from the view's plane, along its axis, that
/// the values 0 (near) and 1 (far) stand for. The value at distance z between them is
///
///     far / (far - near) * (1 - near / z)
///
/// as a perspective projection gives it. `far_m` may be infinite, and either may be the greater.
/// Every value must be that of the surface that the same pixel shows.
struct DepthRange {
    float near_m = 0.0F;
    float far_m = 0.0F;
};

/// What the target knows of the frame that is about to begin.
struct TargetFrame {
    /// Announced middle of the display's emission, host time; unknown where none was announced, or
    /// an absurd one.
    time::Stamp display;
    /// What head and scene are shown for, host time: `display`, or the likeliest one without it.
    std::int64_t aimed_ns = 0;
    std::int64_t period_ns = 0;  ///< of the display; 0: not known
    bool should_render = true;   ///< false: begin and end it, but draw nothing
    gaze::Pose head;             ///< in world, at the display time
    gaze::StereoView views;      ///< in world, at the display time
    gaze::HiddenMeshes hidden;   ///< what of the views no eye sees
    /// What was said of the world's origin since the frame before.
    std::vector<gaze::AnnouncedOrigin> new_origins;
    /// Set by whoever filled the depth images; unset: they are not handed over.
    std::optional<DepthRange> depth;
};

/// Whether the target wants frames.
enum class TargetState {
    Running,  ///< go on with wait_frame
    Idle,     ///< not now; poll again
    Ended,    ///< never again
};

/// Where pictures go: an OpenXR runtime, or nowhere. The loop calls, per frame, in this order:
/// poll, wait_frame, begin_frame, locate, acquire (if should_render), end_frame.
class FrameTarget {
  public:
    FrameTarget() = default;
    FrameTarget(const FrameTarget&) = delete;
    FrameTarget& operator=(const FrameTarget&) = delete;
    virtual ~FrameTarget() = default;

    /// Who must create the Vulkan objects; null: no preference.
    virtual vulkan::Factory* vulkan_factory() = 0;

    /// Makes swapchains or images for the context, once, before anything below. The context must
    /// outlive the target. Throws SetupError.
    virtual void start(const vulkan::Context& context) = 0;

    [[nodiscard]] virtual gaze::PerEye<vk::Extent2D> extents() const = 0;
    [[nodiscard]] virtual vk::Format format() const = 0;
    /// Of the depth images that acquire() gives; nothing: it gives none.
    [[nodiscard]] virtual std::optional<vk::Format> depth_format() const { return std::nullopt; }

    /// Handles what the target has to say; waits a few milliseconds while it is idle.
    /// Throws SetupError (SessionLost) when it is lost.
    virtual TargetState poll() = 0;

    /// Blocks until it is time for the next frame.
    virtual void wait_frame(TargetFrame& frame) = 0;
    virtual void begin_frame() = 0;
    /// Fills in head, views and what they hide at the frame's display time.
    virtual void locate(TargetFrame& frame) = 0;
    virtual gaze::PerEye<render::EyeTarget> acquire() = 0;
    /// Hands over the pictures, if any were acquired, as seen from the frame's views, in
    /// COLOR_ATTACHMENT_OPTIMAL. Also the depth images, if they were filled, in
    /// DEPTH_STENCIL_ATTACHMENT_OPTIMAL.
    virtual void end_frame(const TargetFrame& frame, bool rendered) = 0;

    /// The head pose in world at a past host time, where the target knows it.
    virtual std::optional<gaze::Pose> head_at(std::int64_t time_ns) = 0;

    /// Asks the target to end; frames go on until poll() says Ended.
    virtual void request_exit() = 0;

    /// Name and value pairs for log and session: runtime, its version, system, format ...
    [[nodiscard]] virtual std::vector<std::pair<std::string, std::string>> properties() const = 0;

    /// What happened since the last call, one line each ("session state: FOCUSED").
    virtual std::vector<frame::Event> take_events() = 0;
};

}  // namespace gazeloop::present
