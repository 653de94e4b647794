#include "runtime/vulkan/memory.h"

#include "runtime/vulkan/run_once.h"

namespace gazeloop::vulkan {
namespace {

vk::ImageSubresourceRange whole(vk::ImageAspectFlags aspect) { return {aspect, 0, 1, 0, 1}; }

vk::raii::ImageView make_view(const Context& context, vk::Image image, vk::Format format,
                              vk::ImageAspectFlags aspect) {
    return {context.device(),
            vk::ImageViewCreateInfo({}, image, vk::ImageViewType::e2D, format, {}, whole(aspect))};
}

}  // namespace

HostBuffer::HostBuffer(const Context& context, vk::DeviceSize bytes, vk::BufferUsageFlags usage)
    : bytes_(bytes) {
    const vk::raii::Device& device = context.device();
    buffer_ = vk::raii::Buffer(device, vk::BufferCreateInfo({}, bytes, usage));
    const vk::MemoryRequirements needs = buffer_.getMemoryRequirements();
    const bool read_back = static_cast<bool>(usage & vk::BufferUsageFlagBits::eTransferDst);
    memory_ = vk::raii::DeviceMemory(
        device,
        vk::MemoryAllocateInfo(
            needs.size, context.memory_type(needs.memoryTypeBits,
                                            read_back ? MemoryFor::ReadBack : MemoryFor::Upload)));
    buffer_.bindMemory(*memory_, 0);
    // NOLINTNEXTLINE(cppcoreguidelines-prefer-member-initializer): needs the bound memory
    mapped_ = static_cast<std::byte*>(memory_.mapMemory(0, VK_WHOLE_SIZE));
}

DeviceBuffer::DeviceBuffer(const Context& context, std::span<const std::byte> content,
                           vk::BufferUsageFlags usage, Way way) {
    const vk::raii::Device& device = context.device();
    buffer_ = vk::raii::Buffer(
        device,
        vk::BufferCreateInfo({}, content.size(), usage | vk::BufferUsageFlagBits::eTransferDst));
    const vk::MemoryRequirements needs = buffer_.getMemoryRequirements();
    const std::uint32_t type = context.memory_type(needs.memoryTypeBits, MemoryFor::Device);
    memory_ = vk::raii::DeviceMemory(device, vk::MemoryAllocateInfo(needs.size, type));
    buffer_.bindMemory(*memory_, 0);
    if (way == Way::Shortest && context.is_host_visible(type)) {
        std::memcpy(memory_.mapMemory(0, VK_WHOLE_SIZE), content.data(), content.size());
        memory_.unmapMemory();
        return;
    }
    HostBuffer staging(context, content.size(), vk::BufferUsageFlagBits::eTransferSrc);
    staging.write(content);
    run_once(context, [&](const vk::raii::CommandBuffer& commands) {
        commands.copyBuffer(staging.buffer(), *buffer_, vk::BufferCopy(0, 0, content.size()));
        using Stage = vk::PipelineStageFlagBits2;
        const vk::MemoryBarrier2 written(Stage::eCopy, vk::AccessFlagBits2::eTransferWrite,
                                         Stage::eAllCommands, vk::AccessFlagBits2::eMemoryRead);
        commands.pipelineBarrier2(vk::DependencyInfo({}, written));
    });
}

DeviceImage::DeviceImage(const Context& context, vk::Extent2D extent, vk::Format format,
                         vk::ImageUsageFlags usage)
    : extent_(extent), format_(format) {
    const vk::raii::Device& device = context.device();
    image_ = vk::raii::Image(
        device, vk::ImageCreateInfo({}, vk::ImageType::e2D, format,
                                    vk::Extent3D(extent.width, extent.height, 1), 1, 1,
                                    vk::SampleCountFlagBits::e1, vk::ImageTiling::eOptimal, usage));
    const vk::MemoryRequirements needs = image_.getMemoryRequirements();
    memory_ = vk::raii::DeviceMemory(
        device, vk::MemoryAllocateInfo(
                    needs.size, context.memory_type(needs.memoryTypeBits, MemoryFor::Device)));
    image_.bindMemory(*memory_, 0);
}

ColorImage::ColorImage(const Context& context, vk::Extent2D extent, vk::Format format,
                       vk::ImageUsageFlags usage)
    : DeviceImage(context, extent, format, usage) {
    view_ = make_color_view(context, *image_, format);
}

DepthImage::DepthImage(const Context& context, vk::Extent2D extent, vk::Format format)
    : DeviceImage(
          context, extent, format,
          vk::ImageUsageFlagBits::eDepthStencilAttachment | vk::ImageUsageFlagBits::eTransferSrc) {
    view_ = make_depth_view(context, *image_, format);
}

vk::raii::ImageView make_color_view(const Context& context, vk::Image image, vk::Format format) {
    return make_view(context, image, format, vk::ImageAspectFlagBits::eColor);
}

vk::raii::ImageView make_depth_view(const Context& context, vk::Image image, vk::Format format) {
    return make_view(context, image, format, vk::ImageAspectFlagBits::eDepth);
}

}  // namespace gazeloop::vulkan
