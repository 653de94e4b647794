#include "runtime/vulkan/layered_image.h"

#include <fmt/core.h>

#include <span>

#include "runtime/error.h"
#include "runtime/vulkan/memory.h"
#include "runtime/vulkan/run_once.h"

namespace gazeloop::vulkan {

LayeredImage::LayeredImage(const Context& context, const Form& form) : form_(form) {
    const vk::raii::Device& device = context.device();
    const vk::ImageCreateFlags flags = form.view == vk::ImageViewType::eCube
                                           ? vk::ImageCreateFlagBits::eCubeCompatible
                                           : vk::ImageCreateFlags{};
    image_ = vk::raii::Image(
        device, vk::ImageCreateInfo(flags, vk::ImageType::e2D, form.format,
                                    vk::Extent3D(form.extent.width, form.extent.height, 1),
                                    form.levels, form.layers, vk::SampleCountFlagBits::e1,
                                    vk::ImageTiling::eOptimal, form.usage));
    const vk::MemoryRequirements needs = image_.getMemoryRequirements();
    try {
        memory_ = vk::raii::DeviceMemory(
            device, vk::MemoryAllocateInfo(
                        needs.size, context.memory_type(needs.memoryTypeBits, MemoryFor::Device)));
    } catch (const vk::OutOfDeviceMemoryError&) {
        throw SetupError(ErrorKind::NoDevice,
                         fmt::format("the device has no {} MiB left for an image of {}x{} texels: "
                                     "use smaller pictures (render.scale) or textures",
                                     needs.size >> 20U, form.extent.width, form.extent.height));
    }
    image_.bindMemory(*memory_, 0);
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
        using Stage = vk::PipelineStageFlagBits2;
        using Access = vk::AccessFlagBits2;
        const auto to = [&](vk::ImageLayout from, vk::ImageLayout next, Stage before, Access wrote,
                            Stage after, Access reads) {
            const vk::ImageMemoryBarrier2 barrier(before, wrote, after, reads, from, next,
                                                  VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED,
                                                  image.image(), image.range());
            commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, barrier));
        };
        to(vk::ImageLayout::eUndefined, vk::ImageLayout::eTransferDstOptimal, Stage::eNone,
           Access::eNone, Stage::eCopy, Access::eTransferWrite);
        commands.copyBufferToImage(staging.buffer(), image.image(),
                                   vk::ImageLayout::eTransferDstOptimal, copies);
        to(vk::ImageLayout::eTransferDstOptimal, vk::ImageLayout::eShaderReadOnlyOptimal,
           Stage::eCopy, Access::eTransferWrite, Stage::eFragmentShader,
           Access::eShaderSampledRead);
    });
}

}  // namespace gazeloop::vulkan
