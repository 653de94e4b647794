#pragma once

#include <span>

#include "runtime/foveation/picture/band_tiles.h"
#include "runtime/gaze/seen_depth.h"
#include "runtime/vulkan/memory.h"
#include "runtime/vulkan/tracked_image.h"

namespace gazeloop::render {

/// Reads back how far away it is around one eye's fovea: what the direct buffer's fourth channel
/// holds there.
class FoveaDepth {
  public:
    /// To both sides of the fovea: as far as an eye turns from looking at infinity to looking at
    /// .25 m (.126 rad), so that both are in it whichever the frame was made for, and a tracker's
    /// accuracy; above and below that, and what a gaze that is held moves between two frames.
    static constexpr double kReachAcross_rad = 0.145;
    static constexpr double kReachDown_rad = 0.045;
    /// At most so many pixels to each side: .145 rad at 60 pixels a degree.
    static constexpr std::uint32_t kMostAcross_px = 512;
    static constexpr std::uint32_t kMostDown_px = 128;
    /// And of them at most so many samples: where pixels are left out, at least half as many, each
    /// a third of a degree apart or less, which is a third of what a tracker is off by.
    static constexpr std::uint32_t kMostColumns = 128;
    static constexpr std::uint32_t kMostRows = 32;

    /// For pictures of this size.
    FoveaDepth(const vulkan::Context& context, vk::Extent2D extent);

    /// Records the copy from the direct buffer. Nothing is copied where the fovea's pixel is not
    /// among `disc_bands`. A barrier from Copy to Host is left to the caller.
    void record(const vk::raii::CommandBuffer& commands, vulkan::TrackedImage& direct_buffer,
                const gaze::EyeView& view, const gaze::PixelPosition& fovea,
                std::span<const foveation::Columns> disc_bands);

    /// What was copied, once the GPU has finished it. Reuses the patch's memory: no allocation once
    /// it has grown.
    void collect(gaze::DepthPatch& patch) const;

  private:
    vulkan::HostBuffer pixels_;
    gaze::DepthPatch copied_;  ///< without its samples
    std::uint32_t width_px_ = 0;
};

}  // namespace gazeloop::render
