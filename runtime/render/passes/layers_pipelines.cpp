#include "runtime/render/passes/layers_pipelines.h"

#include <fmt/core.h>

#include "runtime/render/passes/drawing.h"
#include "runtime/render/passes/log_polar_eye.h"
#include "runtime/vulkan/pipelines.h"

namespace gazeloop::render {
namespace {

/// Constants of the composite.
enum CompositeConstant : std::uint32_t { kLayers = kOfMethod, kKept };

/// By bits; in the order of LayersPipelines::Kept.
constexpr std::array<std::uint32_t, 3> kKeptLayers{0b0000, 0b1010, 0b0100};

}  // namespace

LayersPipelines::LayersPipelines(const PassSetup& setup, const LayersConfig& config,
                                 vk::DescriptorSetLayout layer_set,
                                 vk::DescriptorSetLayout composite_set) {
    const vk::raii::Device& device = setup.context.device();
    const auto layout = [&](vk::DescriptorSetLayout method) {
        return vulkan::make_pipeline_layout(
            device, {setup.frame_layout, setup.scene.inputs(), method}, setup.empty_layout);
    };
    layer_layout_ = layout(layer_set);
    composite_layout_ = layout(composite_set);
    const auto samples = with_scene(setup.scene, {{kSamples, setup.samples}});
    shade_ = vulkan::make_pipeline(device, layer_layout_,
                                   {.vertex = "tiles.vert",
                                    .fragment = fmt::format("{}.layers.frag", setup.scene.shader()),
                                    .format = kLpFormat,
                                    .constants = samples});
    if (config.over_frames) {
        temporal_ = vulkan::make_pipeline(device, layer_layout_,
                                          {.vertex = "tiles.vert",
                                           .fragment = "layers_temporal.frag",
                                           .format = kLayerHistoryFormat});
    }
    for (std::size_t kept = 0; kept < kKeptLayers.size(); ++kept) {
        if (kept > 0 && !config.half_rate) {
            continue;
        }
        const std::array composing{
            vulkan::ShaderConstant{kEncodeSrgb, takes_linear(setup.format) ? 0U : 1U},
            vulkan::ShaderConstant{kLayers, static_cast<std::uint32_t>(config.layers)},
            vulkan::ShaderConstant{kKept, kKeptLayers.at(kept)}};
        composites_.at(kept) = vulkan::make_pipeline(device, composite_layout_,
                                                     {.vertex = "full_screen.vert",
                                                      .fragment = resolve_shader("layers", setup),
                                                      .format = setup.format,
                                                      .depth_format = setup.depth_format,
                                                      .constants = composing});
    }
}

}  // namespace gazeloop::render
