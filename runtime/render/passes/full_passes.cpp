#include "runtime/render/passes/full_passes.h"

#include <fmt/core.h>

#include "runtime/foveation/plans/full_plan.h"
#include "runtime/render/passes/drawing.h"
#include "runtime/render/passes/planned_passes.h"
#include "runtime/vulkan/pipelines.h"

namespace gazeloop::render {
namespace {

class FullPasses final : public PlannedPasses<foveation::FullPlan> {
  public:
    explicit FullPasses(const PassSetup& setup)
        : PlannedPasses({"full"}, std::make_unique<foveation::FullPlan>()),
          setup_(setup),
          layout_(vulkan::make_pipeline_layout(setup.context.device(),
                                               {setup.frame_layout, setup.scene.inputs(), {}},
                                               setup.empty_layout)) {
        const auto constants =
            with_scene(setup.scene, {{kEncodeSrgb, takes_linear(setup.format) ? 0U : 1U},
                                     {kSamples, setup.samples},
                                     {kJittered, setup.antialiasing.over_frames ? 1U : 0U}});
        // A variant of its own: the mere statement of a depth costs a third of a resolve.
        const std::string_view suffix =
            setup.depth_format == vk::Format::eUndefined ? "frag" : "depth.frag";
        pipeline_ = vulkan::make_pipeline(
            setup.context.device(), layout_,
            {.vertex = "full_screen.vert",
             .fragment = fmt::format("{}.full.{}", setup.scene.shader(), suffix),
             .format = setup.format,
             .depth_format = setup.depth_format,
             .constants = constants});
    }

    void record_after_gaze(vulkan::PassRecorder& recorder, const FrameRecording& frame,
                           const gaze::PerEye<foveation::EyePlan>& /*plans*/) override {
        const vk::raii::CommandBuffer& commands = recorder.begin("full");
        draw_pictures(commands, frame, setup_, [&](std::size_t e) {
            bind_sets(commands, layout_, frame, e);
            commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline_);
            draw_visible(commands, frame.view.hidden[e].get());
        });
    }

    [[nodiscard]] bool is_foveated() const override { return false; }

  private:
    PassSetup setup_;
    vk::raii::PipelineLayout layout_;
    vk::raii::Pipeline pipeline_{nullptr};
};

}  // namespace

std::unique_ptr<MethodPasses> make_full_passes(const PassSetup& setup) {
    return std::make_unique<FullPasses>(setup);
}

}  // namespace gazeloop::render
