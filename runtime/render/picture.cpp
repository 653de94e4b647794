#include "runtime/render/picture.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>

#include "runtime/render/srgb.h"
#include "runtime/vulkan/run_once.h"

namespace gazeloop::render {
namespace {

std::uint8_t to_byte(double value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

std::uint8_t encode_srgb(float linear) {
    return to_byte(255.0 * srgb_encoded(static_cast<double>(linear)));
}

std::uint32_t bytes_per_pixel(vk::Format format) {
    return format == vk::Format::eR16G16B16A16Sfloat ? 8 : 4;
}

/// All pixels, row by row; the image is left in its layout.
vulkan::HostBuffer copy_to_host(const vulkan::Context& context, vk::Image image,
                                vk::Extent2D extent, vk::ImageAspectFlagBits aspect,
                                vk::ImageLayout layout, vk::DeviceSize bytes) {
    vulkan::HostBuffer buffer(context, bytes * extent.width * extent.height,
                              vk::BufferUsageFlagBits::eTransferDst);
    using Stage = vk::PipelineStageFlagBits2;
    using Access = vk::AccessFlagBits2;
    vulkan::run_once(context, [&](const vk::raii::CommandBuffer& commands) {
        const auto move = [&](vk::ImageLayout from, vk::ImageLayout to) {
            const vk::ImageMemoryBarrier2 barrier(
                Stage::eAllCommands, Access::eMemoryWrite, Stage::eAllCommands,
                Access::eMemoryRead | Access::eMemoryWrite, from, to, VK_QUEUE_FAMILY_IGNORED,
                VK_QUEUE_FAMILY_IGNORED, image, {aspect, 0, 1, 0, 1});
            commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, barrier));
        };
        move(layout, vk::ImageLayout::eTransferSrcOptimal);
        commands.copyImageToBuffer(
            image, vk::ImageLayout::eTransferSrcOptimal, buffer.buffer(),
            vk::BufferImageCopy(0, 0, 0, {aspect, 0, 0, 1}, {}, vk::Extent3D(extent, 1)));
        move(vk::ImageLayout::eTransferSrcOptimal, layout);
        const vk::MemoryBarrier2 to_host(Stage::eCopy, Access::eTransferWrite, Stage::eHost,
                                         Access::eHostRead);
        commands.pipelineBarrier2(vk::DependencyInfo({}, to_host));
    });
    return buffer;
}

}  // namespace

std::vector<float> read_back_depth(const vulkan::Context& context,
                                   const vulkan::DepthImage& image) {
    const vulkan::HostBuffer buffer =
        copy_to_host(context, image.image(), image.extent(), vk::ImageAspectFlagBits::eDepth,
                     vk::ImageLayout::eDepthStencilAttachmentOptimal, sizeof(float));
    std::vector<float> depths(std::size_t{image.extent().width} * image.extent().height);
    std::memcpy(depths.data(), buffer.mapped().data(), depths.size() * sizeof(float));
    return depths;
}

Picture read_back(const vulkan::Context& context, vk::Image image, vk::Extent2D extent,
                  vk::Format format, vk::ImageLayout layout) {
    Picture picture{extent.width, extent.height, {}};
    if (format == vk::Format::eR16G16B16A16Sfloat) {
        const LinearPicture linear = read_back_linear(context, image, extent, format, layout);
        picture.pixels.reserve(linear.pixels.size());
        for (const glm::vec3& pixel : linear.pixels) {
            picture.pixels.push_back(
                {encode_srgb(pixel.x), encode_srgb(pixel.y), encode_srgb(pixel.z)});
        }
        return picture;
    }
    const vulkan::HostBuffer buffer = copy_to_host(
        context, image, extent, vk::ImageAspectFlagBits::eColor, layout, bytes_per_pixel(format));
    picture.pixels.resize(std::size_t{extent.width} * extent.height);
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(buffer.mapped().data());
    const bool bgr = format == vk::Format::eB8G8R8A8Srgb || format == vk::Format::eB8G8R8A8Unorm;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            picture.pixels[i][c] = bytes[i * 4 + (bgr ? 2 - c : c)];
        }
    }
    return picture;
}

LinearPicture read_back_linear(const vulkan::Context& context, vk::Image image, vk::Extent2D extent,
                               vk::Format format, vk::ImageLayout layout) {
    LinearPicture picture{extent.width, extent.height, {}};
    if (format != vk::Format::eR16G16B16A16Sfloat) {
        const Picture encoded = read_back(context, image, extent, format, layout);
        picture.pixels.reserve(encoded.pixels.size());
        for (const auto& pixel : encoded.pixels) {
            picture.pixels.push_back(linear_of(pixel));
        }
        return picture;
    }
    const vulkan::HostBuffer buffer = copy_to_host(
        context, image, extent, vk::ImageAspectFlagBits::eColor, layout, bytes_per_pixel(format));
    picture.pixels.resize(std::size_t{extent.width} * extent.height);
    const std::byte* const bytes = buffer.mapped().data();
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        std::array<std::uint16_t, 4> halves{};
        std::memcpy(halves.data(), bytes + i * sizeof halves, sizeof halves);
        picture.pixels[i] = {glm::unpackHalf1x16(halves[0]), glm::unpackHalf1x16(halves[1]),
                             glm::unpackHalf1x16(halves[2])};
    }
    return picture;
}

Picture amplified_difference(const Picture& a, const Picture& b, double gain) {
    Picture difference{a.width, a.height, {}};
    difference.pixels.resize(a.pixels.size());
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            difference.pixels[i][c] = to_byte(gain * std::abs(a.pixels[i][c] - b.pixels[i][c]));
        }
    }
    return difference;
}

void mark_fovea(Picture& picture, const gaze::PixelPosition& fovea, double radius_px) {
    constexpr std::array<std::uint8_t, 3> kMark{255, 32, 32};
    constexpr double kThickness = 1.5;
    constexpr double kCross = 6.0;
    for (std::uint32_t y = 0; y < picture.height; ++y) {
        for (std::uint32_t x = 0; x < picture.width; ++x) {
            const double dx = std::abs(x + 0.5 - fovea.x_px);
            const double dy = std::abs(y + 0.5 - fovea.y_px);
            const bool ring = std::abs(std::hypot(dx, dy) - radius_px) <= kThickness;
            const bool cross = std::min(dx, dy) <= 1.0 && std::max(dx, dy) <= kCross;
            if (ring || cross) {
                picture.pixels[std::size_t{y} * picture.width + x] = kMark;
            }
        }
    }
}

}  // namespace gazeloop::render
