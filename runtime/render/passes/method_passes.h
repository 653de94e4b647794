#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "runtime/foveation/plans/method_plan.h"
#include "runtime/frame/frame_record.h"
#include "runtime/gaze/seen_depth.h"
#include "runtime/render/antialiasing.h"
#include "runtime/render/frame_view.h"
#include "runtime/render/passes/make_passes.h"
#include "runtime/scene/scene.h"
#include "runtime/vulkan/memory.h"
#include "runtime/vulkan/pass_recorder.h"
#include "runtime/vulkan/tracked_image.h"

namespace gazeloop::render {

/// What the passes of a method are made for.
struct PassSetup {
    const vulkan::Context& context;
    const scene::Scene& scene;
    vk::DescriptorSetLayout frame_layout;  ///< of set 0 (FrameUniforms)
    vk::DescriptorSetLayout empty_layout;  ///< of a set without bindings
    std::uint32_t samples = 1;             ///< per texel or pixel, [1, kMaxSamples]
    gaze::PerEye<vk::Extent2D> extents;
    vk::Format format = vk::Format::eUndefined;
    vk::Format depth_format = vk::Format::eUndefined;  ///< undefined: no depth is written
    std::uint32_t slots = 1;                           ///< frames that may be in flight
    bool seen_depth = false;   ///< depth around the foveae is to be read back
    bool lp_gaussian = false;  ///< smooth the LP-buffer's periphery before the resolve
    Antialiasing antialiasing{};
    /// Radiance that cells outside the plan hold; unset: anything, since no pixel reads them.
    std::optional<std::array<float, 4>> unshaded;
};

/// A frame being recorded.
struct FrameRecording {
    const FrameView& view;
    foveation::FrameInRun in_run;
    std::size_t slot;                            ///< below PassSetup::slots
    gaze::PerEye<vk::DescriptorSet> frame_sets;  ///< set 0
    gaze::PerEye<vk::DescriptorSet> scene_sets;  ///< set 1; null: none
    gaze::PerEye<vulkan::TrackedImage>& color;   ///< of the targets
    gaze::PerEye<vulkan::TrackedImage>& depth;   ///< of the targets, where they have depth
    const gaze::FrameFovea* fovea;               ///< null before the gaze is read
};

/// A picture between scene and result, for people to look at.
struct BufferPicture {
    std::string_view name;  ///< "lp"
    const vulkan::ColorImage* image;
    const foveation::ShadedGrid* grid;  ///< the cells of it that hold something
};

/// What a method does on the GPU: its pipelines and buffers, and what it records for a frame.
/// Planning is its MethodPlan's.
class MethodPasses {
  public:
    MethodPasses() = default;
    MethodPasses(const MethodPasses&) = delete;
    MethodPasses& operator=(const MethodPasses&) = delete;
    virtual ~MethodPasses() = default;

    /// In the order in which they are recorded; fixed.
    [[nodiscard]] virtual const frame::PassList& passes() const = 0;
    [[nodiscard]] virtual const foveation::MethodPlan& plan() const = 0;

    /// Whether prepare() for these views would change nothing.
    [[nodiscard]] virtual bool fits(const gaze::StereoView& views) const = 0;
    /// Makes what depends on fields of view. Precondition: no frame is unfinished on the GPU.
    virtual void prepare(const gaze::StereoView& views) = 0;

    /// Records what needs no gaze.
    virtual void record_before_gaze(vulkan::PassRecorder&, const FrameRecording&) {}
    /// Records the rest, by plans of this gaze. The targets are in use as ColorTarget (and
    /// DepthTarget) after it.
    virtual void record_after_gaze(vulkan::PassRecorder& recorder, const FrameRecording& frame,
                                   const gaze::PerEye<foveation::EyePlan>& plans) = 0;

    /// Whether samples lie farther apart somewhere than elsewhere.
    [[nodiscard]] virtual bool is_foveated() const { return true; }
    /// The angle around the fovea between neighbouring samples of a log-polar method, rad. 0: it
    /// has none. Precondition: prepare().
    [[nodiscard]] virtual double row_angle_rad(gaze::Eye) const { return 0.0; }

    /// Whether it keeps the depth around the foveae for the host.
    [[nodiscard]] virtual bool keeps_depth() const { return false; }
    /// Records the copy of that depth; only called if keeps_depth().
    virtual void record_depth_copies(const vk::raii::CommandBuffer&, const FrameRecording&,
                                     const gaze::PerEye<foveation::EyePlan>&,
                                     const gaze::FrameFovea&) {}
    /// What was copied, once the GPU has finished the frame of that slot.
    virtual void collect_depth(std::size_t /*slot*/, gaze::SeenDepth&) const {}

    /// What the last frame left between scene and result, of one eye, by the frame's plan.
    [[nodiscard]] virtual std::vector<BufferPicture> buffers(gaze::Eye,
                                                             const foveation::EyePlan&) const {
        return {};
    }
};

}  // namespace gazeloop::render
