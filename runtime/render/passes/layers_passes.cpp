#include "runtime/render/passes/layers_passes.h"

#include <fmt/core.h>

#include <cmath>
#include <string>
#include <utility>

#include "runtime/render/fovea_depth.h"
#include "runtime/render/jitter.h"
#include "runtime/render/passes/drawing.h"
#include "runtime/render/passes/eye_sets.h"
#include "runtime/render/passes/layers_pipelines.h"
#include "runtime/render/passes/log_polar_eye.h"
#include "runtime/render/passes/planned_passes.h"
#include "runtime/render/passes/seen_layer.h"
#include "runtime/vulkan/history.h"

namespace gazeloop::render {
namespace {

using foveation::LayeredPlan;

constexpr std::size_t kMostLayers = LayeredPlan::kMostLayers;

/// Images of a layer's set.
enum LayerImage : std::uint32_t { kBefore, kFresh, kLayerImages };

frame::PassList pass_list(std::size_t layers) {
    std::string text;
    for (std::size_t i = 1; i <= layers; ++i) {
        text += fmt::format("layer_{} ", i);
    }
    return value_or_throw(frame::PassList::parse(text + "composite", frame::kMostPasses));
}

class LayersPasses final : public PlannedPasses<LayeredPlan> {
  public:
    LayersPasses(const PassSetup& setup, const LayersConfig& config,
                 LayeredPlan::LayersOf layers_of)
        : PlannedPasses(
              pass_list(config.layers),
              std::make_unique<LayeredPlan>(
                  foveation::LayeredOptions{.layers = config.layers,
                                            .half_rate = config.half_rate,
                                            .kept = config.half_rate || config.over_frames},
                  std::move(layers_of))),
          setup_(setup),
          config_(config),
          sampler_(make_sampler(setup.context.device(), vk::Filter::eNearest)),
          composite_sets_(setup, {.uniform_bytes = sizeof(LayerUniforms), .images = kMostLayers},
                          *sampler_) {
        for (std::size_t i = 0; i < config.layers; ++i) {
            layer_sets_.emplace_back(
                setup,
                EyeSets::Shape{.uniform_bytes = sizeof(LayerUniforms), .images = kLayerImages},
                *sampler_);
        }
        pipelines_.emplace(setup, config, layer_sets_.front().layout(), composite_sets_.layout());
        if (setup.seen_depth) {
            depths_ = FoveaDepths(setup.context, setup.extents, setup.slots);
        }
    }

    void record_after_gaze(vulkan::PassRecorder& recorder, const FrameRecording& frame,
                           const gaze::PerEye<foveation::EyePlan>& plans) override {
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            take_turns(frame, e, plans[e]);
        }
        const auto shade = [&](const vk::raii::CommandBuffer& commands, std::size_t layer) {
            for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
                if (its_turn(plans[e], layer)) {
                    shade_layer(commands, frame, e, layer, plans[e].grids[layer].tiles);
                }
            }
        };
        const auto any = [&](std::size_t layer) {
            return !plans[0].grids[layer].tiles.empty() || !plans[1].grids[layer].tiles.empty();
        };
        for (std::size_t layer = 0; layer < config_.layers; ++layer) {
            if (any(layer)) {
                shade(recorder.begin(passes()[layer]), layer);
            }
        }
        // A layer without any cell is not submitted for itself; what it has to prepare goes along.
        const vk::raii::CommandBuffer& commands = recorder.begin("composite");
        for (std::size_t layer = 0; layer < config_.layers; ++layer) {
            if (!any(layer)) {
                shade(commands, layer);
            }
        }
        draw_pictures(commands, frame, setup_, [&](std::size_t e) {
            bind_sets(commands, pipelines_->composite_layout(), frame, e,
                      composite_sets_.of(frame.slot, e));
            commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *composite(e, plans[e]));
            draw_visible(commands, frame.view.hidden[e].get());
        });
    }

    [[nodiscard]] bool keeps_depth() const override { return setup_.seen_depth; }

    /// The inner layer's cells are pixels of the picture.
    void record_depth_copies(const vk::raii::CommandBuffer& commands, const FrameRecording& frame,
                             const gaze::PerEye<foveation::EyePlan>& plans,
                             const gaze::FrameFovea& fovea) override {
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            const glm::uvec4 covers(LayeredPlan::layer_of(plans[e], 0).covers);
            Layer& inner = layers_[e].front();
            vulkan::TrackedColorImage& cells =
                config_.over_frames ? inner.fresh : inner.history.now();
            depths_.of(frame.slot, e)
                .record(commands, cells.tracked, frame.view.views[e], fovea.eyes[e].position,
                        plans[e].grids[0].bands,
                        {covers.x, covers.y, covers.x + covers.z, covers.y + covers.w});
        }
    }

    void collect_depth(std::size_t slot, gaze::SeenDepth& seen) const override {
        depths_.collect(slot, seen);
    }

  private:
    void attach() override {
        for (const gaze::Eye eye : gaze::kEyes) {
            make_layers(eye);
        }
    }

    /// What an eye keeps of a layer from frame to frame.
    struct Layer {
        vulkan::History history;
        vulkan::TrackedColorImage fresh;  ///< as shaded; only where frames are mixed
        Jitter jitter;
        SeenLayer shown;
        SeenLayer before;
    };

    static bool its_turn(const foveation::EyePlan& plan, std::size_t layer) {
        return LayeredPlan::layer_of(plan, layer).cells.w > 0.0F;
    }

    [[nodiscard]] vk::Format format() const {
        return config_.over_frames ? kLayerHistoryFormat : kLpFormat;
    }

    /// The composite for the layers that an eye keeps from the last frame.
    [[nodiscard]] const vk::raii::Pipeline& composite(std::size_t e,
                                                      const foveation::EyePlan& plan) const {
        const std::size_t layers = this->plan().layers(gaze::kEyes.at(e)).size();
        using Kept = LayersPipelines::Kept;
        Kept kept = Kept::None;
        for (std::size_t layer = 1; layer < layers; ++layer) {
            if (!its_turn(plan, layer)) {
                kept = layer % 2 == 1 ? Kept::SecondAndFourth : Kept::Third;
            }
        }
        return pipelines_->composite(kept);
    }

    /// Images for any gaze: a layer's rectangle may be the whole picture.
    void make_layers(gaze::Eye eye) {
        const std::size_t e = gaze::index(eye);
        const vk::Extent2D picture = setup_.extents[e];
        const std::vector<foveation::LayerShape>& shapes = plan().layers(eye);
        std::array<vk::ImageView, kMostLayers> views;
        for (std::size_t i = 0; i < config_.layers; ++i) {
            Layer& layer = layers_[e].at(i);
            layer = {};
            const double factor = i < shapes.size() ? shapes[i].factor : picture.width;
            const auto cells = [&](std::uint32_t pixels) {
                return static_cast<std::uint32_t>(std::max(1.0, std::ceil(pixels / factor)));
            };
            const vk::Extent2D extent(cells(picture.width), cells(picture.height));
            layer.history = vulkan::History(setup_.context, extent, format());
            layer.history.advance();
            if (config_.over_frames) {
                using Usage = vk::ImageUsageFlagBits;
                layer.fresh = {setup_.context, extent, kLpFormat,
                               Usage::eColorAttachment | Usage::eSampled | Usage::eTransferSrc};
            }
            views.at(i) = layer.history.now().image.view();
        }
        for (std::size_t i = config_.layers; i < kMostLayers; ++i) {
            views.at(i) = views[0];
        }
        const std::size_t table = plan().table_words(picture.height);
        for (std::size_t i = 0; i < config_.layers; ++i) {
            layer_sets_[i].attach(
                e, table, {},
                std::array{views.at(i), config_.over_frames ? layers_[e].at(i).fresh.image.view()
                                                            : views.at(i)});
        }
        composite_sets_.attach(e, table, {}, views);
    }

    /// What of an eye's layers is shown in this frame, and what of them was before.
    void take_turns(const FrameRecording& frame, std::size_t e, const foveation::EyePlan& plan) {
        LayerUniforms uniforms;
        for (std::size_t i = 0; i < config_.layers; ++i) {
            Layer& layer = layers_[e].at(i);
            if (!frame.in_run.follows) {
                layer.history.reset();
                layer.jitter.reset();
                layer.shown = {};
            }
            const LayeredPlan::Layer planned = LayeredPlan::layer_of(plan, i);
            if (planned.cells.w > 0.0F) {
                layer.before = layer.shown;
                layer.shown = seen_now(frame.view.views[e], plan, planned);
                if (config_.over_frames) {
                    const glm::dvec2 jitter = layer.jitter.offset();
                    layer.shown.cells.z = static_cast<float>(jitter.x);
                    layer.shown.cells.w = static_cast<float>(jitter.y);
                    layer.jitter.advance();
                }
                layer.history.advance();
                if (layer.history.before() == nullptr) {
                    layer.before = {};
                }
                layer_sets_[i].attach_image(frame.slot, e, kBefore,
                                            layer.history.other().image.view());
            }
            // What a view has no layer for is never shaded: any image does.
            const bool exists = i < this->plan().layers(gaze::kEyes[e]).size();
            uniforms.shown.at(i) = layer.shown;
            uniforms.before.at(i) = layer.before;
            uniforms.first_band[static_cast<glm::length_t>(i)] = planned.cells.z;
            composite_sets_.attach_image(
                frame.slot, e, static_cast<std::uint32_t>(i),
                (exists ? layer : layers_[e].front()).history.now().image.view());
        }
        for (std::size_t i = config_.layers; i < kMostLayers; ++i) {
            composite_sets_.attach_image(frame.slot, e, static_cast<std::uint32_t>(i),
                                         layers_[e].front().history.now().image.view());
        }
        for (EyeSets& sets : layer_sets_) {
            sets.write(frame.slot, e, uniforms, plan.table);
        }
        composite_sets_.write(frame.slot, e, uniforms, plan.table);
    }

    void shade_layer(const vk::raii::CommandBuffer& commands, const FrameRecording& frame,
                     std::size_t e, std::size_t layer, std::span<const foveation::Tile> tiles) {
        Layer& shaded = layers_[e].at(layer);
        vulkan::TrackedColorImage& now = shaded.history.now();
        const auto draw = [&](const vk::raii::Pipeline& pipeline,
                              vulkan::TrackedColorImage& cells) {
            commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline);
            shade_cells(commands, cells, tiles, static_cast<std::uint32_t>(layer), setup_.unshaded);
        };
        bind_sets(commands, pipelines_->layer_layout(), frame, e,
                  layer_sets_[layer].of(frame.slot, e));
        if (!config_.over_frames) {
            draw(pipelines_->shade(), now);
            return;
        }
        draw(pipelines_->shade(), shaded.fresh);
        shaded.history.other().tracked.use(
            commands, vulkan::Use::Sampled,
            shaded.history.before() != nullptr ? vulkan::Keep::Content : vulkan::Keep::Nothing);
        draw(pipelines_->temporal(), now);
    }

    PassSetup setup_;
    LayersConfig config_;
    vk::raii::Sampler sampler_;
    std::vector<EyeSets> layer_sets_;
    EyeSets composite_sets_;
    std::optional<LayersPipelines> pipelines_;
    gaze::PerEye<std::array<Layer, kMostLayers>> layers_;
    FoveaDepths depths_;
};

}  // namespace

std::unique_ptr<MethodPasses> make_layers_passes(const PassSetup& setup, const LayersConfig& config,
                                                 LayeredPlan::LayersOf layers_of) {
    return std::make_unique<LayersPasses>(setup, config, std::move(layers_of));
}

}  // namespace gazeloop::render
