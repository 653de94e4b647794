#include "runtime/render/passes/log_polar_sets.h"

namespace gazeloop::render {

void write_map(const vk::raii::Device& device, vk::DescriptorSet set, vk::Buffer uniforms,
               const MapBuffers& map, vk::Buffer bands) {
    const std::array buffers{uniforms, map.map_tables(), map.column_table(), map.row_table(),
                             bands};
    std::uint32_t binding = 0;
    for (const vk::Buffer buffer : buffers) {
        const vk::DescriptorBufferInfo info(buffer, 0, VK_WHOLE_SIZE);
        device.updateDescriptorSets(
            vk::WriteDescriptorSet(set, binding, 0, kMapBindings.at(binding), {}, info), {});
        ++binding;
    }
}

void write_image(const vk::raii::Device& device, vk::DescriptorSet set, std::uint32_t binding,
                 vk::Sampler sampler, vk::ImageView view) {
    const vk::DescriptorImageInfo info(sampler, view, vk::ImageLayout::eShaderReadOnlyOptimal);
    device.updateDescriptorSets(
        vk::WriteDescriptorSet(set, binding, 0, vk::DescriptorType::eCombinedImageSampler, info),
        {});
}

void write_storage_image(const vk::raii::Device& device, vk::DescriptorSet set,
                         std::uint32_t binding, vk::ImageView view) {
    const vk::DescriptorImageInfo info({}, view, vk::ImageLayout::eGeneral);
    device.updateDescriptorSets(
        vk::WriteDescriptorSet(set, binding, 0, vk::DescriptorType::eStorageImage, info), {});
}

vk::raii::Sampler make_lp_sampler(const vk::raii::Device& device) {
    using Mode = vk::SamplerAddressMode;
    return {device, vk::SamplerCreateInfo({}, vk::Filter::eLinear, vk::Filter::eLinear,
                                          vk::SamplerMipmapMode::eNearest, Mode::eClampToEdge,
                                          Mode::eRepeat, Mode::eClampToEdge)};
}

}  // namespace gazeloop::render
