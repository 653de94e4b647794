#include "runtime/render/fovea_depth.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "runtime/foveation/picture/shaded_around.h"

namespace gazeloop::render {
namespace {

constexpr std::size_t kBytesPerPixel = 8;  // of kLpFormat
constexpr std::size_t kNearnessByte = 6;   // its fourth channel

/// Pixels of an axis that an angle spans at a place, rounded up.
std::uint32_t reach_px(double angle_rad, double first_rad, double last_rad, std::uint32_t size_px,
                       double place_px, std::uint32_t most_px) {
    const double first = std::tan(first_rad);
    const double px_per_tangent = size_px / std::abs(std::tan(last_rad) - first);
    const double tangent = std::lerp(first, std::tan(last_rad), place_px / size_px);
    const double px = std::ceil(angle_rad * px_per_tangent * (1.0 + tangent * tangent));
    return static_cast<std::uint32_t>(std::clamp(px, 1.0, static_cast<double>(most_px)));
}

std::uint32_t divided_up(std::uint32_t count, std::uint32_t by) { return (count + by - 1) / by; }

}  // namespace

FoveaDepth::FoveaDepth(const vulkan::Context& context, vk::Extent2D extent)
    : pixels_(context,
              vk::DeviceSize{std::min(extent.width, 2 * kMostAcross_px + 1)} *
                  std::min(extent.height, 2 * kMostDown_px + 1) * kBytesPerPixel,
              vk::BufferUsageFlagBits::eTransferDst) {}

void FoveaDepth::record(const vk::raii::CommandBuffer& commands,
                        vulkan::TrackedImage& direct_buffer, const gaze::EyeView& view,
                        const gaze::PixelPosition& fovea, std::span<const foveation::Columns> bands,
                        const foveation::Tile& covers) {
    const std::uint32_t across = reach_px(kReachAcross_rad, view.fov.left_rad, view.fov.right_rad,
                                          view.width_px, fovea.x_px, kMostAcross_px);
    const std::uint32_t down = reach_px(kReachDown_rad, view.fov.up_rad, view.fov.down_rad,
                                        view.height_px, fovea.y_px, kMostDown_px);
    const foveation::Tile tile =
        foveation::shaded_around({fovea.x_px - covers.x0, fovea.y_px - covers.y0}, across, down,
                                 {covers.x1 - covers.x0, covers.y1 - covers.y0}, bands);
    width_px_ = tile.x1 - tile.x0;
    const std::uint32_t height_px = tile.y1 - tile.y0;
    copied_.view = view;
    copied_.x0_px = covers.x0 + tile.x0;
    copied_.y0_px = covers.y0 + tile.y0;
    copied_.step_x_px = std::max(divided_up(width_px_, kMostColumns), 1U);
    copied_.step_y_px = std::max(divided_up(height_px, kMostRows), 1U);
    copied_.columns = divided_up(width_px_, copied_.step_x_px);
    copied_.rows = divided_up(height_px, copied_.step_y_px);
    if (tile.area() == 0) {
        return;
    }
    direct_buffer.use(commands, vulkan::Use::CopySource);
    commands.copyImageToBuffer(
        direct_buffer.image(), vk::ImageLayout::eTransferSrcOptimal, pixels_.buffer(),
        vk::BufferImageCopy(
            0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1},
            {static_cast<std::int32_t>(tile.x0), static_cast<std::int32_t>(tile.y0), 0},
            {width_px_, height_px, 1}));
}

void FoveaDepth::collect(gaze::DepthPatch& patch) const {
    patch.view = copied_.view;
    patch.x0_px = copied_.x0_px;
    patch.y0_px = copied_.y0_px;
    patch.step_x_px = copied_.step_x_px;
    patch.step_y_px = copied_.step_y_px;
    patch.columns = copied_.columns;
    patch.rows = copied_.rows;
    patch.nearness.reserve(std::size_t{kMostColumns} * kMostRows);
    patch.nearness.resize(std::size_t{copied_.columns} * copied_.rows);
    const std::byte* const pixels = pixels_.mapped().data();
    auto next = patch.nearness.begin();
    for (std::size_t row = 0; row < copied_.rows; ++row) {
        for (std::size_t column = 0; column < copied_.columns; ++column) {
            const std::size_t pixel =
                row * copied_.step_y_px * width_px_ + column * copied_.step_x_px;
            std::memcpy(&*next++, pixels + pixel * kBytesPerPixel + kNearnessByte,
                        sizeof(std::uint16_t));
        }
    }
}

FoveaDepths::FoveaDepths(const vulkan::Context& context, const gaze::PerEye<vk::Extent2D>& extents,
                         std::uint32_t slots)
    : slots_(slots) {
    for (auto& slot : slots_) {
        for (const vk::Extent2D extent : extents) {
            slot.emplace_back(context, extent);
        }
    }
}

void FoveaDepths::collect(std::size_t slot, gaze::SeenDepth& seen) const {
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        slots_[slot][e].collect(seen[e]);
    }
}

}  // namespace gazeloop::render
