#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "runtime/frame/frame_record.h"
#include "runtime/gaze/seen_depth.h"
#include "runtime/gaze/view.h"
#include "runtime/render/antialiasing.h"
#include "runtime/render/camera_motion.h"
#include "runtime/render/frame_view.h"
#include "runtime/render/jitter.h"
#include "runtime/render/last_views.h"
#include "runtime/render/passes/method_passes.h"
#include "runtime/scene/scene.h"
#include "runtime/vulkan/clock.h"
#include "runtime/vulkan/memory.h"

namespace gazeloop::render {

struct RendererConfig {
    std::uint32_t samples = 1;  ///< per texel or pixel, [1, kMaxSamples]
    gaze::PerEye<vk::Extent2D> extents;
    vk::Format format = vk::Format::eR8G8B8A8Srgb;
    /// Format of the targets' depth images (depth.h says what they hold); undefined: none is
    /// written.
    vk::Format depth_format = vk::Format::eUndefined;
    bool profile = true;                 ///< a submit and a pair of timestamps for each pass
    bool hash = false;                   ///< read every picture back and hash it
    bool seen_depth = false;             ///< read back the scene's distance around the foveae
    std::uint32_t frames_in_flight = 2;  ///< [1, 3]
    /// The 3 x 3 Gaussian over a log-polar buffer's periphery.
    FilterUse lp_gaussian = FilterUse::AsSceneNeeds;
    Antialiasing antialiasing{};
    CameraMotion camera = CameraMotion::Still;
    /// Radiance that cells outside the plan hold; unset: anything, since no pixel reads them.
    std::optional<std::array<float, 4>> unshaded;
};

/// Renders both eyes' pictures by a scene and a method's passes, times every pass and counts its
/// samples. Knows no method by name.
///
/// Per frame: wait_for_slot(), next_finished() until it yields nothing, begin(), then read the
/// gaze, then finish(). So neither waiting for the GPU nor work that needs no gaze makes the gaze
/// older. Finished frames come back through next_finished() in order.
class FrameRenderer {
  public:
    /// The scene must outlive this. Throws SetupError (Usage) for parameters out of range.
    FrameRenderer(const vulkan::Context& context, scene::Scene& scene,
                  const MakePasses& make_passes, const RendererConfig& config);
    FrameRenderer(const FrameRenderer&) = delete;
    FrameRenderer& operator=(const FrameRenderer&) = delete;
    ~FrameRenderer();

    /// Blocks until at most `in_flight` - 1 frames are unfinished on the GPU. `in_flight` is at
    /// most the configured number, which is the default.
    void wait_for_slot();
    void wait_for_slot(std::uint32_t in_flight);

    /// Makes what depends on the fields of view, if these have changed. Takes milliseconds, so call
    /// it before the gaze is read. begin() does it if nobody has.
    void prepare(const gaze::StereoView& views);

    /// Begins a frame: records and submits what needs no gaze. Precondition: wait_for_slot() and
    /// the drained next_finished() since the last frame. The view must outlive finish().
    void begin(const FrameView& view);
    /// Blocks until the GPU has finished what begin() submitted, if anything: the rest then waits
    /// only for the gaze.
    void wait_for_begun();
    /// The only part that reads the gaze: plans, records and submits the rest. Precondition:
    /// begin().
    frame::SampleCounts finish(const gaze::FrameFovea& fovea);

    /// The next frame that the GPU has finished, if there is one.
    std::optional<frame::FrameGpuRecord> next_finished();

    /// Waits for the GPU; next_finished() then yields every frame left.
    void wait_idle();

    [[nodiscard]] const RendererConfig& config() const { return config_; }
    /// Passes of scene and method, in the order in which they are recorded.
    [[nodiscard]] const frame::PassList& passes() const { return passes_; }
    [[nodiscard]] const frame::GridList& grids() const { return method_->plan().grids(); }
    [[nodiscard]] const foveation::EyePlan& last_plan(gaze::Eye eye) const {
        return plans_[gaze::index(eye)];
    }
    /// What the last frame left between scene and result (SHADER_READ_ONLY_OPTIMAL).
    [[nodiscard]] std::vector<BufferPicture> buffers(gaze::Eye eye) const {
        return method_->buffers(eye, last_plan(eye));
    }
    /// How far away the scene was around the foveae, in the frame that next_finished() returned
    /// last. Patches are empty where the configuration does not ask for them, and where the method
    /// kept no depth at the fovea: off screen, without a disc, by methods that keep none.
    [[nodiscard]] const gaze::SeenDepth& seen_depth() const { return seen_depth_; }
    [[nodiscard]] std::uint64_t clock_deviation_ns() const { return clock_.max_deviation_ns(); }

  private:
    struct Slot;

    void make_slots();
    [[nodiscard]] FrameRecording recording(Slot& slot, const FrameView& view,
                                           const gaze::FrameFovea* fovea);
    [[nodiscard]] glm::dvec2 next_offset();
    [[nodiscard]] gaze::PerEye<std::optional<foveation::EyeBefore>> before(
        const FrameView& view) const;
    void record_copies(Slot& slot, const FrameRecording& frame, const gaze::FrameFovea& fovea);
    [[nodiscard]] frame::FrameGpuRecord collect(Slot& slot);
    void wait_for(vk::Semaphore timeline, std::uint64_t value) const;

    const vulkan::Context* context_;
    std::unique_ptr<scene::Scene> own_scene_;  ///< of these pictures; null: the shared one serves
    scene::Scene* scene_;
    RendererConfig config_;
    vulkan::GpuClock clock_;
    vk::raii::DescriptorSetLayout frame_layout_{nullptr};
    vk::raii::DescriptorSetLayout empty_layout_{nullptr};
    std::unique_ptr<MethodPasses> method_;
    frame::PassList passes_;
    vk::raii::DescriptorPool pool_{nullptr};
    vk::raii::Semaphore timeline_{nullptr};  ///< frames finished
    vk::raii::Semaphore begun_{nullptr};     ///< begin() parts finished
    std::uint64_t submitted_ = 0;            ///< frames; the timeline's value
    std::uint64_t begun_submitted_ = 0;
    std::uint64_t collected_ = 0;
    const FrameView* given_ = nullptr;  ///< between begin() and finish(), as the next one
    const FrameView* view_ = nullptr;   ///< the given one, carried
    FrameView carried_;
    foveation::FrameInRun in_run_;  ///< of the frame that was begun last
    gaze::PerEye<foveation::EyePlan> plans_;
    LastViews last_views_;
    double last_scene_time_s_ = 0.0;                   ///< of the frame that was begun last
    gaze::PerEye<gaze::PixelPosition> last_foveae_{};  ///< that the last frame was planned for
    Jitter jitter_;
    gaze::SeenDepth seen_depth_;
    std::vector<std::unique_ptr<Slot>> slots_;
};

}  // namespace gazeloop::render
