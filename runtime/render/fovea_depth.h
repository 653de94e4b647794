#pragma once

#include <span>
#include <vector>

#include "runtime/foveation/picture/band_tiles.h"
#include "runtime/foveation/picture/tile.h"
#include "runtime/gaze/seen_depth.h"
#include "runtime/vulkan/memory.h"
#include "runtime/vulkan/tracked_image.h"

namespace gazeloop::render {

/// Reads back how far away the scene is around one eye's fovea: the direct buffer's fourth channel.
class FoveaDepth {
  public:
    /// Half-width of the patch: the .126 rad that an eye turns between infinity and .25 m, plus a
    /// tracker's error. So the patch holds the fovea of either assumption. Half-height: a tracker's
    /// error plus the movement of a held gaze between two frames.
    static constexpr double kReachAcross_rad = 0.145;
    static constexpr double kReachDown_rad = 0.045;
    /// At most this many pixels to each side: .145 rad at 60 pixels per degree.
    static constexpr std::uint32_t kMostAcross_px = 512;
    static constexpr std::uint32_t kMostDown_px = 128;
    /// At most this many samples of these pixels. Where pixels are left out, there are at least
    /// half as many samples, at most a third of a degree apart: a third of a tracker's error.
    static constexpr std::uint32_t kMostColumns = 128;
    static constexpr std::uint32_t kMostRows = 32;

    /// For pictures of this size.
    FoveaDepth(const vulkan::Context& context, vk::Extent2D extent);

    /// Records the copy from a buffer of pixels that were shaded directly. Nothing is copied where
    /// the fovea's pixel is not among `bands`. A barrier from Copy to Host is left to the caller.
    /// `covers`: the part of the picture that buffer and bands begin at and belong to.
    void record(const vk::raii::CommandBuffer& commands, vulkan::TrackedImage& direct_buffer,
                const gaze::EyeView& view, const gaze::PixelPosition& fovea,
                std::span<const foveation::Columns> bands, const foveation::Tile& covers);
    /// The same of a buffer of the whole picture.
    void record(const vk::raii::CommandBuffer& commands, vulkan::TrackedImage& direct_buffer,
                const gaze::EyeView& view, const gaze::PixelPosition& fovea,
                std::span<const foveation::Columns> bands) {
        record(commands, direct_buffer, view, fovea, bands, {0, 0, view.width_px, view.height_px});
    }

    /// What was copied, once the GPU has finished it. Reuses the patch's memory: no allocation once
    /// it has grown.
    void collect(gaze::DepthPatch& patch) const;

  private:
    vulkan::HostBuffer pixels_;
    gaze::DepthPatch copied_;  ///< without its samples
    std::uint32_t width_px_ = 0;
};

/// Of both eyes, for each frame in flight.
class FoveaDepths {
  public:
    FoveaDepths() = default;
    FoveaDepths(const vulkan::Context& context, const gaze::PerEye<vk::Extent2D>& extents,
                std::uint32_t slots);

    [[nodiscard]] FoveaDepth& of(std::size_t slot, std::size_t eye) { return slots_[slot][eye]; }
    void collect(std::size_t slot, gaze::SeenDepth& seen) const;

  private:
    std::vector<std::vector<FoveaDepth>> slots_;  ///< by eye
};

}  // namespace gazeloop::render
