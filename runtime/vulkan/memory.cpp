#include "runtime/vulkan/memory.h"

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
    using Property = vk::MemoryPropertyFlagBits;
    const vk::MemoryPropertyFlags shared = Property::eHostVisible | Property::eHostCoherent;
    const vk::MemoryPropertyFlags cached = shared | Property::eHostCached;
    const bool read_back = static_cast<bool>(usage & vk::BufferUsageFlagBits::eTransferDst);
    const auto cached_type =
        read_back ? context.find_memory_type(needs.memoryTypeBits, cached) : std::nullopt;
    memory_ = vk::raii::DeviceMemory(
        device, vk::MemoryAllocateInfo(
                    needs.size, cached_type ? *cached_type
                                            : context.memory_type(needs.memoryTypeBits, shared)));
    buffer_.bindMemory(*memory_, 0);
    // NOLINTNEXTLINE(cppcoreguidelines-prefer-member-initializer): needs the bound memory
    mapped_ = static_cast<std::byte*>(memory_.mapMemory(0, VK_WHOLE_SIZE));
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
                    needs.size, context.memory_type(needs.memoryTypeBits,
                                                    vk::MemoryPropertyFlagBits::eDeviceLocal)));
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

vk::ImageMemoryBarrier2 image_barrier(vk::Image image, vk::ImageLayout from, vk::ImageLayout to,
                                      vk::PipelineStageFlags2 after, vk::AccessFlags2 writes,
                                      vk::PipelineStageFlags2 before, vk::AccessFlags2 reads,
                                      vk::ImageAspectFlags aspect) {
    return {after,
            writes,
            before,
            reads,
            from,
            to,
            VK_QUEUE_FAMILY_IGNORED,
            VK_QUEUE_FAMILY_IGNORED,
            image,
            whole(aspect)};
}

}  // namespace gazeloop::vulkan
