#pragma once

#include <array>
#include <vulkan/vulkan_raii.hpp>

#include "runtime/render/passes/layers_passes.h"

namespace gazeloop::render {

/// A history is never rounded to halves, because its error would add up.
inline constexpr vk::Format kLayerHistoryFormat = vk::Format::eR32G32B32A32Sfloat;

/// The pipelines of eccentricity layers, and their layouts.
class LayersPipelines {
  public:
    /// `layer_set`, `composite_set`: layouts of descriptor set 2.
    LayersPipelines(const PassSetup& setup, const LayersConfig& config,
                    vk::DescriptorSetLayout layer_set, vk::DescriptorSetLayout composite_set);

    [[nodiscard]] const vk::raii::PipelineLayout& layer_layout() const { return layer_layout_; }
    [[nodiscard]] const vk::raii::PipelineLayout& composite_layout() const {
        return composite_layout_;
    }
    /// Shades a layer's cells.
    [[nodiscard]] const vk::raii::Pipeline& shade() const { return shade_; }
    /// Mixes them with the last frames'. Null without LayersConfig::over_frames.
    [[nodiscard]] const vk::raii::Pipeline& temporal() const { return temporal_; }
    /// Which layers are kept from the last frame: none; the second and fourth, whose turn is in one
    /// frame; the third, whose turn is in the next. But for None only with LayersConfig::half_rate.
    enum class Kept : std::uint8_t { None, SecondAndFourth, Third };
    [[nodiscard]] const vk::raii::Pipeline& composite(Kept kept) const {
        return composites_.at(static_cast<std::size_t>(kept));
    }

  private:
    vk::raii::PipelineLayout layer_layout_{nullptr};
    vk::raii::PipelineLayout composite_layout_{nullptr};
    vk::raii::Pipeline shade_{nullptr};
    vk::raii::Pipeline temporal_{nullptr};
    std::array<vk::raii::Pipeline, 3> composites_{nullptr, nullptr, nullptr};
};

}  // namespace gazeloop::render
