#include "runtime/render/picture.h"

#include <fmt/core.h>
#include <png.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <glm/gtc/packing.hpp>
#include <limits>
#include <memory>

namespace gazeloop::render {
namespace {

std::uint8_t to_byte(double value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

/// IEC 61966-2-1.
std::uint8_t encode_srgb(float linear) {
    const double c = std::clamp(static_cast<double>(linear), 0.0, 1.0);
    return to_byte(255.0 * (c < 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055));
}

std::uint32_t bytes_per_pixel(vk::Format format) {
    return format == vk::Format::eR16G16B16A16Sfloat ? 8 : 4;
}

void run_once(const vulkan::Context& context, auto&& record) {
    const vk::raii::Device& device = context.device();
    const vk::raii::CommandPool pool(
        device, vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eTransient,
                                          context.queue_family()));
    const vk::raii::CommandBuffers buffers(
        device, vk::CommandBufferAllocateInfo(*pool, vk::CommandBufferLevel::ePrimary, 1));
    const vk::raii::CommandBuffer& commands = buffers[0];
    commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    record(commands);
    commands.end();
    const vk::CommandBufferSubmitInfo info(*commands);
    context.queue().submit2(vk::SubmitInfo2({}, {}, info));
    context.device().waitIdle();
}

/// All pixels, row by row; the image is left in its layout.
vulkan::HostBuffer copy_to_host(const vulkan::Context& context, vk::Image image,
                                vk::Extent2D extent, vk::ImageAspectFlagBits aspect,
                                vk::ImageLayout layout, vk::DeviceSize bytes) {
    vulkan::HostBuffer buffer(context, bytes * extent.width * extent.height,
                              vk::BufferUsageFlagBits::eTransferDst);
    using Stage = vk::PipelineStageFlagBits2;
    using Access = vk::AccessFlagBits2;
    run_once(context, [&](const vk::raii::CommandBuffer& commands) {
        const auto move = [&](vk::ImageLayout from, vk::ImageLayout to) {
            const auto barrier = vulkan::image_barrier(
                image, from, to, Stage::eAllCommands, Access::eMemoryWrite, Stage::eAllCommands,
                Access::eMemoryRead | Access::eMemoryWrite, aspect);
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
    const vulkan::HostBuffer buffer = copy_to_host(
        context, image, extent, vk::ImageAspectFlagBits::eColor, layout, bytes_per_pixel(format));
    const std::size_t count = std::size_t{extent.width} * extent.height;
    Picture picture{extent.width, extent.height, {}};
    picture.pixels.resize(count);
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(buffer.mapped().data());
    if (format == vk::Format::eR16G16B16A16Sfloat) {
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
                std::uint16_t half = 0;
                std::memcpy(&half, bytes + i * 8 + c * 2, sizeof half);
                picture.pixels[i][c] = encode_srgb(glm::unpackHalf1x16(half));
            }
        }
        return picture;
    }
    const bool bgr = format == vk::Format::eB8G8R8A8Srgb || format == vk::Format::eB8G8R8A8Unorm;
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            picture.pixels[i][c] = bytes[i * 4 + (bgr ? 2 - c : c)];
        }
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

Expected<void> write_png(const Picture& picture, const std::filesystem::path& file) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = picture.width;
    image.height = picture.height;
    image.format = PNG_FORMAT_RGB;
    if (png_image_write_to_file(&image, file.c_str(), 0, picture.pixels.data(), 0, nullptr) == 0) {
        return std::unexpected(
            Error{ErrorKind::BadInput, fmt::format("{}: the picture could not be written ({}); "
                                                   "is the folder there and writable?",
                                                   file.string(), image.message)});
    }
    return {};
}

}  // namespace gazeloop::render
