#pragma once

#include <optional>

#include "runtime/foveation/log_polar/lp_size.h"
#include "runtime/foveation/log_polar/map_tables.h"
#include "runtime/render/map_buffers.h"
#include "runtime/vulkan/tracked_color_image.h"

namespace gazeloop::render {

/// Format of LP-buffer and disc: linear light, filterable.
inline constexpr vk::Format kLpFormat = vk::Format::eR16G16B16A16Sfloat;

/// What one eye's log-polar rendering keeps on the GPU from frame to frame. The map's tables, which
/// no gaze changes, the LP-buffer, and a picture-sized buffer for the disc's pixels.
class LogPolarEye {
  public:
    /// `samples` per texel.
    /// `smoothed`: with a second LP-buffer, for a filter.
    LogPolarEye(const vulkan::Context& context, const foveation::MapTables& tables,
                foveation::LpSize lp, vk::Extent2D picture, std::uint32_t samples, bool smoothed);

    using Buffer = vulkan::TrackedColorImage;
    [[nodiscard]] Buffer& lp_buffer() { return lp_buffer_; }
    [[nodiscard]] const Buffer& lp_buffer() const { return lp_buffer_; }
    /// The LP-buffer after the filter. Precondition: it was made with one.
    [[nodiscard]] Buffer& smoothed_buffer() { return *smoothed_buffer_; }
    /// Pixels of the picture that are shaded directly; only those of the plan's disc are written.
    [[nodiscard]] Buffer& direct_buffer() { return direct_buffer_; }
    [[nodiscard]] const MapBuffers& map_buffers() const { return map_buffers_; }

    /// Most bands that a plan of this eye can have.
    [[nodiscard]] std::size_t max_bands() const;

  private:
    Buffer lp_buffer_;
    std::optional<Buffer> smoothed_buffer_;
    Buffer direct_buffer_;
    MapBuffers map_buffers_;
};

}  // namespace gazeloop::render
