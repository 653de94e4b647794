#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/foveation/picture/hidden_area.h"
#include "runtime/foveation/plans/sampling_plan.h"
#include "runtime/frame/frame_record.h"
#include "runtime/gaze/seen_depth.h"
#include "runtime/gaze/view.h"
#include "runtime/render/eye_target.h"
#include "runtime/render/log_polar_eye.h"
#include "runtime/render/method.h"
#include "runtime/vulkan/clock.h"
#include "runtime/vulkan/memory.h"

namespace gazeloop::render {

struct RendererConfig {
    Method method = Method::Kfr;
    std::string scene = "raymarch";
    std::uint32_t samples = 1;  ///< a texel or pixel, [1, kMaxSamples]
    foveation::KfrParameters kfr;
    foveation::AcuityParameters acuity;
    gaze::PerEye<vk::Extent2D> extents;
    vk::Format format = vk::Format::eR8G8B8A8Srgb;
    /// Of the targets' depth images (depth.h says what they hold); undefined: none is written.
    vk::Format depth_format = vk::Format::eUndefined;
    bool profile = true;                 ///< a submit and a pair of timestamps for each pass
    bool hash = false;                   ///< read every picture back and hash it
    bool seen_depth = false;             ///< read back how far away it is around the foveae
    std::uint32_t frames_in_flight = 2;  ///< [1, 3]
    /// Radiance that texels outside the plan hold; unset: anything, since no pixel reads them.
    std::optional<std::array<float, 4>> lp_background;
};

/// One frame to render: everything that depends on time, head or gaze.
struct FrameRequest {
    std::uint64_t index = 0;
    double scene_time_s = 0.0;
    gaze::StereoView views;
    gaze::PerEye<gaze::PixelPosition> foveae;
    /// Unit vectors in the views' frames: the foveae as angles, for methods in the gaze's frame.
    gaze::PerEye<glm::dvec3> gaze_directions{};
    /// Any layout before; after, COLOR_ATTACHMENT_OPTIMAL and DEPTH_STENCIL_ATTACHMENT_OPTIMAL.
    gaze::PerEye<EyeTarget> targets;
    foveation::HiddenAreas hidden{};  ///< of these views; what they hide is black
};

/// Renders both eyes' pictures by scene x method, times every pass and counts its samples.
///
/// Per frame: wait_for_slot(), next_finished() until it yields nothing, then read the gaze, then
/// render(); so that waiting for the GPU never makes the gaze older. Finished frames come back
/// through next_finished() in order.
class FrameRenderer {
  public:
    /// Throws SetupError (Usage) for parameters out of range or an unknown scene.
    FrameRenderer(const vulkan::Context& context, const RendererConfig& config);
    FrameRenderer(const FrameRenderer&) = delete;
    FrameRenderer& operator=(const FrameRenderer&) = delete;
    ~FrameRenderer();

    /// Blocks until at most `in_flight` - 1 frames are unfinished on the GPU. `in_flight` is at
    /// most the configured number, which is the default.
    void wait_for_slot();
    void wait_for_slot(std::uint32_t in_flight);

    /// Makes what depends on the fields of view, if they are others than before, which takes
    /// milliseconds: before the gaze is read. render() does it where nobody has.
    void prepare(const gaze::StereoView& views);

    /// Submits a frame. Precondition: wait_for_slot() and the drained next_finished() since the
    /// last call.
    frame::SampleCounts render(const FrameRequest& request);

    /// The next frame that the GPU has finished, if there is one.
    std::optional<frame::FrameGpuRecord> next_finished();

    /// Waits for the GPU; next_finished() then yields every frame left.
    void wait_idle();

    [[nodiscard]] const RendererConfig& config() const { return config_; }
    [[nodiscard]] const frame::PassList& passes() const { return passes_; }
    [[nodiscard]] const frame::GridList& grids() const { return grids_; }
    /// The LP-buffer as the last frame left it (SHADER_READ_ONLY_OPTIMAL); null for Method::Full,
    /// and for Method::Acuity before the first frame, and texels that the plan left out hold
    /// anything.
    [[nodiscard]] const LogPolarEye* log_polar_eye(gaze::Eye eye) const;
    [[nodiscard]] const foveation::SamplingPlan& last_plan(gaze::Eye eye) const;
    /// How far away it was around the foveae, in the frame that next_finished() returned last.
    /// Patches are empty where the configuration does not ask for them, and where no pixel was
    /// shaded directly at the fovea: off screen, without a disc, by Method::Full.
    [[nodiscard]] const gaze::SeenDepth& seen_depth() const { return seen_depth_; }
    [[nodiscard]] std::uint64_t clock_deviation_ns() const { return clock_.max_deviation_ns(); }

  private:
    struct EyeSlot;
    struct Slot;

    [[nodiscard]] bool keeps_depth() const {
        return config_.seen_depth && config_.method != Method::Full;
    }
    void make_slots();
    void attach_eye(std::size_t eye, std::unique_ptr<LogPolarEye> made);
    void begin_segment(Slot& slot, std::string_view pass);
    void end_segments(Slot& slot);
    void shade_tiles(Slot& slot, std::size_t eye, const vulkan::ColorImage& target,
                     std::span<const foveation::Tile> tiles, bool direct);
    template <typename DrawEye>  // no std::function: no allocation a frame
    void draw_pictures(const Slot& slot, const FrameRequest& request, const DrawEye& draw_eye);
    void draw_resolve(const Slot& slot, const foveation::SamplingPlan& plan,
                      const foveation::HiddenArea* hidden);
    void record_full(Slot& slot, const FrameRequest& request);
    void record_log_polar(Slot& slot, const FrameRequest& request);
    void record_copies(Slot& slot, const FrameRequest& request);
    void record_picture_copies(Slot& slot, const FrameRequest& request);
    void record_depth_copies(Slot& slot, const FrameRequest& request);
    void submit(Slot& slot);
    [[nodiscard]] frame::FrameGpuRecord collect(Slot& slot);

    const vulkan::Context* context_;
    RendererConfig config_;
    frame::PassList passes_;
    frame::GridList grids_;
    vulkan::GpuClock clock_;
    vk::raii::DescriptorSetLayout set_layout_{nullptr};
    vk::raii::PipelineLayout layout_{nullptr};
    vk::raii::Pipeline full_{nullptr};
    vk::raii::Pipeline pass_i_{nullptr};
    vk::raii::Pipeline resolve_{nullptr};
    vk::raii::Pipeline resolve_disc_{nullptr};
    vk::raii::Sampler sampler_{nullptr};
    vk::raii::DescriptorPool pool_{nullptr};
    vk::raii::Semaphore timeline_{nullptr};
    std::uint64_t submitted_ = 0;  ///< frames; the timeline's value
    std::uint64_t collected_ = 0;
    gaze::PerEye<std::unique_ptr<LogPolarEye>> eyes_;
    gaze::PerEye<foveation::SamplingPlan> plans_;
    gaze::SeenDepth seen_depth_;
    std::vector<std::unique_ptr<Slot>> slots_;
};

}  // namespace gazeloop::render
