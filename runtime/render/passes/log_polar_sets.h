#pragma once

#include <array>
#include <vulkan/vulkan_raii.hpp>

#include "runtime/render/map_buffers.h"

namespace gazeloop::render {

/// The first bindings of descriptor set 2 of log-polar passes (shaders/lib/log_polar.glsl and
/// bands.glsl): MapUniforms, MapTables, columns, rows, bands.
inline constexpr std::array kMapBindings{
    vk::DescriptorType::eUniformBuffer, vk::DescriptorType::eUniformBuffer,
    vk::DescriptorType::eStorageBuffer, vk::DescriptorType::eStorageBuffer,
    vk::DescriptorType::eStorageBuffer};

/// Lets a set read a map. `uniforms` holds MapUniforms, `bands` a plan's bands.
void write_map(const vk::raii::Device& device, vk::DescriptorSet set, vk::Buffer uniforms,
               const MapBuffers& map, vk::Buffer bands);

/// Lets a set read an image at a binding through a sampler.
void write_image(const vk::raii::Device& device, vk::DescriptorSet set, std::uint32_t binding,
                 vk::Sampler sampler, vk::ImageView view);

/// Lets a set read an image at a binding as a storage image, texel by texel. On lavapipe 22.3 that
/// costs half of a texelFetch(), which finds the size of a mip level for each lane. Not while it is
/// drawn into: see ARCHITECTURE.md, "What to know about lavapipe".
void write_storage_image(const vk::raii::Device& device, vk::DescriptorSet set,
                         std::uint32_t binding, vk::ImageView view);

/// Filters an LP-buffer: columns end, rows wrap.
[[nodiscard]] vk::raii::Sampler make_lp_sampler(const vk::raii::Device& device);

}  // namespace gazeloop::render
