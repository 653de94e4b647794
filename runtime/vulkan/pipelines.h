#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vulkan/vulkan_raii.hpp>

#include "runtime/vulkan/context.h"

namespace gazeloop::vulkan {

/// Descriptor sets by whose they are (shaders/lib). Every binding of a layout must be written
/// before a set of it is bound, used or not: lavapipe 22.3 follows them all.
inline constexpr std::uint32_t kFrameSet = 0;
inline constexpr std::uint32_t kSceneSet = 1;
inline constexpr std::uint32_t kMethodSet = 2;

/// A set's bindings 0, 1, ... in this order, one descriptor each, for these shader stages.
vk::raii::DescriptorSetLayout make_set_layout(const vk::raii::Device& device,
                                              std::span<const vk::DescriptorType> bindings,
                                              vk::ShaderStageFlags stages);

/// Of the sets of frame, scene and method. A null layout is a set without bindings, which is never
/// bound: `empty` stands for it. No push constants: lavapipe 22.3 compiles a fragment shader anew
/// for each set of their values.
vk::raii::PipelineLayout make_pipeline_layout(const vk::raii::Device& device,
                                              std::array<vk::DescriptorSetLayout, 3> sets,
                                              vk::DescriptorSetLayout empty);

/// A specialization constant: its constant_id and value.
struct ShaderConstant {
    std::uint32_t id;
    std::uint32_t value;
};

struct PipelineSource {
    std::string_view vertex;  ///< names as shaders::spirv takes them
    std::string_view fragment;
    vk::Format format;
    vk::Format depth_format = vk::Format::eUndefined;  ///< undefined: no depth is written
    std::span<const ShaderConstant> constants{};
};

/// A pipeline for dynamic rendering into one colour attachment and, if its shader writes depth, a
/// depth attachment that takes every value; viewport and scissor dynamic.
vk::raii::Pipeline make_pipeline(const vk::raii::Device& device,
                                 const vk::raii::PipelineLayout& layout,
                                 const PipelineSource& source);

}  // namespace gazeloop::vulkan
