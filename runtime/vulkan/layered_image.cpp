#include "runtime/vulkan/layered_image.h"

#include <fmt/core.h>

#include <algorithm>
#include <span>

#include "runtime/error.h"
#include "runtime/vulkan/memory.h"
#include "runtime/vulkan/run_once.h"

namespace gazeloop::vulkan {
namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

vk::ImageCreateInfo create_info(const LayeredImage::Form& form) {
    const vk::ImageCreateFlags flags = form.view == vk::ImageViewType::eCube
                                           ? vk::ImageCreateFlagBits::eCubeCompatible
                                           : vk::ImageCreateFlags{};
    return {flags,
            vk::ImageType::e2D,
            form.format,
            vk::Extent3D(form.extent.width, form.extent.height, 1),
            form.levels,
            form.layers,
            vk::SampleCountFlagBits::e1,
            vk::ImageTiling::eOptimal,
            form.usage};
}

/// What was in a part of an image is lost.
vk::ImageMemoryBarrier2 to_be_written(const LayeredImage& image,
                                      const vk::ImageSubresourceRange& range, Stage read_before) {
    return {read_before,
            Access::eNone,
            Stage::eCopy,
            Access::eTransferWrite,
            vk::ImageLayout::eUndefined,
            vk::ImageLayout::eTransferDstOptimal,
            VK_QUEUE_FAMILY_IGNORED,
            VK_QUEUE_FAMILY_IGNORED,
            image.image(),
            range};
}

vk::ImageMemoryBarrier2 to_be_read(const LayeredImage& image,
                                   const vk::ImageSubresourceRange& range) {
    return {Stage::eCopy,
            Access::eTransferWrite,
            Stage::eFragmentShader,
            Access::eShaderSampledRead,
            vk::ImageLayout::eTransferDstOptimal,
            vk::ImageLayout::eShaderReadOnlyOptimal,
            VK_QUEUE_FAMILY_IGNORED,
            VK_QUEUE_FAMILY_IGNORED,
            image.image(),
            range};
}

}  // namespace

LayeredImage::LayeredImage(const Context& context, const Form& form) : form_(form) {
    const vk::raii::Device& device = context.device();
    image_ = vk::raii::Image(device, create_info(form));
    const vk::MemoryRequirements needs = image_.getMemoryRequirements();
    try {
        memory_ = vk::raii::DeviceMemory(
            device, vk::MemoryAllocateInfo(
                        needs.size, context.memory_type(needs.memoryTypeBits, MemoryFor::Device)));
        image_.bindMemory(*memory_, 0);
    } catch (const vk::OutOfDeviceMemoryError&) {
        throw SetupError(
            ErrorKind::NoDevice,
            fmt::format("the device has no {} MiB left for an image of {}x{} texels: use smaller "
                        "pictures (render.scale), textures, or a smaller lightfield.memory_mib",
                        needs.size >> 20U, form.extent.width, form.extent.height));
    }
    memory_bytes_ = needs.size;
    view_ = vk::raii::ImageView(
        device, vk::ImageViewCreateInfo({}, *image_, form.view, form.format, {}, range()));
    if (form.usage & (vk::ImageUsageFlagBits::eColorAttachment |
                      vk::ImageUsageFlagBits::eDepthStencilAttachment)) {
        for (std::uint32_t layer = 0; layer < form.layers; ++layer) {
            layer_views_.emplace_back(
                device, vk::ImageViewCreateInfo({}, *image_, vk::ImageViewType::e2D, form.format,
                                                {}, {form.aspect, 0, 1, layer, 1}));
        }
    }
}

void upload(const Context& context, const LayeredImage& image,
            const std::vector<LevelTexels>& texels) {
    constexpr vk::DeviceSize kAlignment = 16;
    vk::DeviceSize size = 0;
    std::vector<vk::BufferImageCopy> copies;
    const vk::ImageAspectFlags aspect = image.range().aspectMask;
    for (const LevelTexels& part : texels) {
        copies.emplace_back(size, 0, 0,
                            vk::ImageSubresourceLayers(aspect, part.level, part.layer, 1),
                            vk::Offset3D{}, vk::Extent3D(part.extent, 1));
        size += (part.bytes.size() + kAlignment - 1) / kAlignment * kAlignment;
    }
    HostBuffer staging(context, size, vk::BufferUsageFlagBits::eTransferSrc);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        staging.write(std::span<const std::byte>(texels[i].bytes), copies[i].bufferOffset);
    }
    run_once(context, [&](const vk::raii::CommandBuffer& commands) {
        const auto before = to_be_written(image, image.range(), Stage::eNone);
        commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, before));
        commands.copyBufferToImage(staging.buffer(), image.image(),
                                   vk::ImageLayout::eTransferDstOptimal, copies);
        const auto after = to_be_read(image, image.range());
        commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, after));
    });
}

vk::DeviceSize memory_needed(const Context& context, const LayeredImage::Form& form) {
    const vk::ImageCreateInfo info = create_info(form);
    return context.device()
        .getImageMemoryRequirements(vk::DeviceImageMemoryRequirements(&info))
        .memoryRequirements.size;
}

vk::DeviceSize most_memory(const Context& context) {
    const auto chain = context.physical()
                           .getProperties2<vk::PhysicalDeviceProperties2,
                                           vk::PhysicalDeviceMaintenance3Properties>();
    const vk::PhysicalDeviceMemoryProperties memory = context.physical().getMemoryProperties();
    const std::uint32_t type = context.memory_type(~0U, MemoryFor::Device);
    return std::min(chain.get<vk::PhysicalDeviceMaintenance3Properties>().maxMemoryAllocationSize,
                    memory.memoryHeaps[memory.memoryTypes[type].heapIndex].size);
}

void make_readable(const Context& context, const LayeredImage& image) {
    run_once(context, [&](const vk::raii::CommandBuffer& commands) {
        const vk::ImageMemoryBarrier2 barrier(
            Stage::eNone, Access::eNone, Stage::eFragmentShader, Access::eShaderSampledRead,
            vk::ImageLayout::eUndefined, vk::ImageLayout::eShaderReadOnlyOptimal,
            VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, image.image(), image.range());
        commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, barrier));
    });
}

void replace_layers(const vk::raii::CommandBuffer& commands, const LayeredImage& image,
                    vk::Buffer from, std::span<const LayerSource> layers) {
    const vk::ImageAspectFlags aspect = image.range().aspectMask;
    std::vector<vk::ImageMemoryBarrier2> before;
    std::vector<vk::BufferImageCopy> copies;
    std::vector<vk::ImageMemoryBarrier2> after;
    for (const LayerSource& part : layers) {
        const vk::ImageSubresourceRange range(aspect, 0, 1, part.layer, 1);
        before.push_back(to_be_written(image, range, Stage::eFragmentShader));
        copies.emplace_back(part.offset, 0, 0, vk::ImageSubresourceLayers(aspect, 0, part.layer, 1),
                            vk::Offset3D{}, vk::Extent3D(image.extent(), 1));
        after.push_back(to_be_read(image, range));
    }
    commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, before));
    commands.copyBufferToImage(from, image.image(), vk::ImageLayout::eTransferDstOptimal, copies);
    commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, after));
}

}  // namespace gazeloop::vulkan
