#include "runtime/render/passes/rings_passes.h"

#include <fmt/core.h>

#include <utility>

#include "runtime/render/fovea_depth.h"
#include "runtime/render/passes/drawing.h"
#include "runtime/render/passes/eye_sets.h"
#include "runtime/render/passes/log_polar_eye.h"
#include "runtime/render/passes/planned_passes.h"
#include "runtime/vulkan/pipelines.h"

namespace gazeloop::render {
namespace {

constexpr unsigned kRates = 3;

class RingsPasses final : public PlannedPasses<foveation::RingsPlan> {
  public:
    RingsPasses(const PassSetup& setup, foveation::RingsPlan::RingsOf rings_of)
        : PlannedPasses({"shade", "resolve"},
                        std::make_unique<foveation::RingsPlan>(std::move(rings_of))),
          setup_(setup),
          sampler_(make_sampler(setup.context.device(), vk::Filter::eNearest)),
          sets_(setup, {.images = kRates}, *sampler_),
          layout_(vulkan::make_pipeline_layout(
              setup.context.device(), {setup.frame_layout, setup.scene.inputs(), sets_.layout()},
              setup.empty_layout)) {
        const vk::raii::Device& device = setup.context.device();
        const auto samples = with_scene(setup.scene, {{kSamples, setup.samples}});
        shade_ =
            vulkan::make_pipeline(device, layout_,
                                  {.vertex = "tiles.vert",
                                   .fragment = fmt::format("{}.rings.frag", setup.scene.shader()),
                                   .format = kLpFormat,
                                   .constants = samples});
        const std::array encode{
            vulkan::ShaderConstant{kEncodeSrgb, takes_linear(setup.format) ? 0U : 1U}};
        resolve_ = vulkan::make_pipeline(device, layout_,
                                         {.vertex = "full_screen.vert",
                                          .fragment = resolve_shader("rings", setup),
                                          .format = setup.format,
                                          .depth_format = setup.depth_format,
                                          .constants = encode});
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            make_cells(e);
        }
        if (setup.seen_depth) {
            depths_ = FoveaDepths(setup.context, setup.extents, setup.slots);
        }
    }

    void record_after_gaze(vulkan::PassRecorder& recorder, const FrameRecording& frame,
                           const gaze::PerEye<foveation::EyePlan>& plans) override {
        const vk::raii::CommandBuffer& shading = recorder.begin("shade");
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            sets_.write(frame.slot, e, plans[e]);
            bind_sets(shading, layout_, frame, e, sets_.of(frame.slot, e));
            shading.bindPipeline(vk::PipelineBindPoint::eGraphics, *shade_);
            for (unsigned rate = 0; rate < kRates; ++rate) {
                shade_cells(shading, cells_[e].at(rate), plans[e].grids[rate].tiles, rate,
                            setup_.unshaded);
            }
        }
        const vk::raii::CommandBuffer& commands = recorder.begin("resolve");
        draw_pictures(commands, frame, setup_, [&](std::size_t e) {
            bind_sets(commands, layout_, frame, e, sets_.of(frame.slot, e));
            commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *resolve_);
            draw_visible(commands, frame.view.hidden[e].get());
        });
    }

    [[nodiscard]] bool keeps_depth() const override { return setup_.seen_depth; }

    void record_depth_copies(const vk::raii::CommandBuffer& commands, const FrameRecording& frame,
                             const gaze::PerEye<foveation::EyePlan>& plans,
                             const gaze::FrameFovea& fovea) override {
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            depths_.of(frame.slot, e)
                .record(commands, cells_[e][0].tracked, frame.view.views[e], fovea.eyes[e].position,
                        plans[e].grids[0].bands);
        }
    }

    void collect_depth(std::size_t slot, gaze::SeenDepth& seen) const override {
        depths_.collect(slot, seen);
    }

  private:
    void make_cells(std::size_t e) {
        using Usage = vk::ImageUsageFlagBits;
        const vk::Extent2D picture = setup_.extents[e];
        std::array<vk::ImageView, kRates> views;
        for (unsigned rate = 0; rate < kRates; ++rate) {
            const std::uint32_t more = (1U << rate) - 1;
            vulkan::TrackedColorImage& cells = cells_[e].at(rate);
            cells = {setup_.context,
                     {(picture.width + more) >> rate, (picture.height + more) >> rate},
                     kLpFormat,
                     Usage::eColorAttachment | Usage::eSampled | Usage::eTransferSrc};
            views.at(rate) = cells.image.view();
        }
        sets_.attach(e, foveation::RingsPlan::table_words(picture.height), {}, views);
    }

    PassSetup setup_;
    vk::raii::Sampler sampler_;
    EyeSets sets_;
    vk::raii::PipelineLayout layout_;
    vk::raii::Pipeline shade_{nullptr};
    vk::raii::Pipeline resolve_{nullptr};
    gaze::PerEye<std::array<vulkan::TrackedColorImage, kRates>> cells_;
    FoveaDepths depths_;
};

}  // namespace

std::unique_ptr<MethodPasses> make_rings_passes(const PassSetup& setup,
                                                foveation::RingsPlan::RingsOf rings_of) {
    return std::make_unique<RingsPasses>(setup, std::move(rings_of));
}

}  // namespace gazeloop::render
