#include "runtime/render/passes/log_polar_eye.h"

#include "runtime/foveation/picture/band_tiles.h"

namespace gazeloop::render {
namespace {

LogPolarEye::Buffer make_buffer(const vulkan::Context& context, vk::Extent2D extent) {
    using Usage = vk::ImageUsageFlagBits;
    return {context, extent, kLpFormat,
            Usage::eColorAttachment | Usage::eSampled | Usage::eTransferSrc};
}

}  // namespace

LogPolarEye::LogPolarEye(const vulkan::Context& context, const foveation::MapTables& tables,
                         foveation::LpSize lp, vk::Extent2D picture, std::uint32_t samples,
                         bool smoothed)
    : lp_buffer_(make_buffer(context, vk::Extent2D(lp.width, lp.height))),
      direct_buffer_(make_buffer(context, picture)),
      map_buffers_(context, tables, samples, lp.height) {
    if (smoothed) {
        smoothed_buffer_ = make_buffer(context, vk::Extent2D(lp.width, lp.height));
    }
}

std::size_t LogPolarEye::max_bands() const {
    return std::size_t{lp_buffer_.image.extent().height / foveation::kBandRows} +
           direct_buffer_.image.extent().height / foveation::kBandRows + 2;
}

}  // namespace gazeloop::render
