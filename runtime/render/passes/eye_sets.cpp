#include "runtime/render/passes/eye_sets.h"

#include <algorithm>

#include "runtime/vulkan/pipelines.h"

namespace gazeloop::render {
namespace {

using Type = vk::DescriptorType;

constexpr std::uint32_t kFirstBuffer = 2;

}  // namespace

EyeSets::EyeSets(const PassSetup& setup, const Shape& shape, vk::Sampler sampler)
    : context_(&setup.context), first_image_(kFirstBuffer + shape.buffers), sampler_(sampler) {
    const vk::raii::Device& device = context_->device();
    std::vector<Type> bindings{Type::eUniformBuffer, Type::eStorageBuffer};
    bindings.insert(bindings.end(), shape.buffers, Type::eStorageBuffer);
    bindings.insert(bindings.end(), shape.images, Type::eCombinedImageSampler);
    layout_ = vulkan::make_set_layout(device, bindings, vk::ShaderStageFlagBits::eFragment);
    const std::uint32_t sets = setup.slots * static_cast<std::uint32_t>(gaze::kEyeCount);
    const std::array sizes{
        vk::DescriptorPoolSize(Type::eUniformBuffer, sets),
        vk::DescriptorPoolSize(Type::eStorageBuffer, (1 + shape.buffers) * sets),
        vk::DescriptorPoolSize(Type::eCombinedImageSampler, std::max(shape.images, 1U) * sets)};
    pool_ = vk::raii::DescriptorPool(
        device, vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
                                             sets, sizes));
    slots_.resize(setup.slots);
    for (auto& slot : slots_) {
        for (EyeSlot& at : slot) {
            at.uniforms = vulkan::HostBuffer(*context_, shape.uniform_bytes,
                                             vk::BufferUsageFlagBits::eUniformBuffer);
            at.set = std::move(vk::raii::DescriptorSets(
                device, vk::DescriptorSetAllocateInfo(*pool_, *layout_))[0]);
            write_buffer(at, 0, Type::eUniformBuffer, at.uniforms.buffer());
        }
    }
}

void EyeSets::attach(std::size_t eye, std::size_t table_words, std::span<const vk::Buffer> buffers,
                     std::span<const vk::ImageView> images) {
    for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
        EyeSlot& at = slots_[slot][eye];
        at.table = vulkan::HostBuffer(*context_,
                                      std::max<std::size_t>(table_words, 1) * sizeof(std::uint32_t),
                                      vk::BufferUsageFlagBits::eStorageBuffer);
        write_buffer(at, 1, Type::eStorageBuffer, at.table.buffer());
        std::uint32_t binding = kFirstBuffer;
        for (const vk::Buffer buffer : buffers) {
            write_buffer(at, binding++, Type::eStorageBuffer, buffer);
        }
        for (std::uint32_t image = 0; image < images.size(); ++image) {
            attach_image(slot, eye, image, images[image]);
        }
    }
}

void EyeSets::attach_image(std::size_t slot, std::size_t eye, std::uint32_t image,
                           vk::ImageView view) {
    const vk::DescriptorImageInfo info(sampler_, view, vk::ImageLayout::eShaderReadOnlyOptimal);
    context_->device().updateDescriptorSets(
        vk::WriteDescriptorSet(of(slot, eye), first_image_ + image, 0, Type::eCombinedImageSampler,
                               info),
        {});
}

void EyeSets::write_buffer(const EyeSlot& at, std::uint32_t binding, vk::DescriptorType type,
                           vk::Buffer buffer) const {
    const vk::DescriptorBufferInfo info(buffer, 0, VK_WHOLE_SIZE);
    context_->device().updateDescriptorSets(
        vk::WriteDescriptorSet(*at.set, binding, 0, type, {}, info), {});
}

}  // namespace gazeloop::render
