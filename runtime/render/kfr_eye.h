#pragma once

#include "runtime/foveation/sampling_plan.h"
#include "runtime/render/gpu_memory.h"

namespace gazeloop::render {

/// Format of LP-buffer and disc: linear light, filterable.
inline constexpr vk::Format kLpFormat = vk::Format::eR16G16B16A16Sfloat;

/// What one eye's kernel foveated rendering keeps on the GPU from frame to frame: the map's tables,
/// which no gaze changes, the LP-buffer, and a picture-sized buffer for the disc's pixels.
class KfrEye {
  public:
    KfrEye(const VulkanContext& context, const foveation::KfrParameters& parameters,
           foveation::ImageSize image);

    [[nodiscard]] const foveation::KfrParameters& parameters() const { return parameters_; }
    [[nodiscard]] foveation::LpSize lp() const { return lp_; }
    [[nodiscard]] foveation::ImageSize image() const { return image_; }
    [[nodiscard]] const ColorImage& lp_buffer() const { return lp_buffer_; }
    /// Pixels of the picture that are shaded directly; only those of the plan's disc are written.
    [[nodiscard]] const ColorImage& direct_buffer() const { return direct_buffer_; }
    [[nodiscard]] vk::Buffer map_tables() const { return map_tables_.buffer(); }
    [[nodiscard]] vk::Buffer column_table() const { return column_table_.buffer(); }
    [[nodiscard]] vk::Buffer row_table() const { return row_table_.buffer(); }

    /// Most bands that a plan of this eye can have.
    [[nodiscard]] std::size_t max_bands() const;

  private:
    foveation::KfrParameters parameters_;
    foveation::ImageSize image_;
    foveation::LpSize lp_;
    ColorImage lp_buffer_;
    ColorImage direct_buffer_;
    HostBuffer map_tables_;
    HostBuffer column_table_;
    HostBuffer row_table_;
};

}  // namespace gazeloop::render
