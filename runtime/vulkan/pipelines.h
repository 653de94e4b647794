#pragma once

#include <string_view>
#include <vulkan/vulkan_raii.hpp>

#include "runtime/vulkan/context.h"

namespace gazeloop::vulkan {

/// The bindings of descriptor set 0, the same for every pass of a method (shaders/lib).
enum Binding : std::uint32_t {
    kEyeUniformsBinding = 0,
    kMapTablesBinding = 1,
    kColumnTableBinding = 2,
    kRowTableBinding = 3,
    kBandsBinding = 4,
    kLpBufferBinding = 5,
    kDirectBufferBinding = 6,
};

/// What a method's passes read. Every binding of a layout must be written before a set of it is
/// bound, used or not: lavapipe 22.3 follows them all.
enum class Inputs {
    Uniforms,          ///< EyeUniforms alone
    UniformsAndLpMap,  ///< all bindings
};
vk::raii::DescriptorSetLayout make_set_layout(const vk::raii::Device& device, Inputs inputs);

/// No push constants: lavapipe 22.3 compiles a fragment shader anew for each set of their values.
vk::raii::PipelineLayout make_pipeline_layout(const vk::raii::Device& device,
                                              const vk::raii::DescriptorSetLayout& set_layout);

struct PipelineSource {
    std::string_view vertex;  ///< names as shaders::spirv takes them
    std::string_view fragment;
    vk::Format format;
    vk::Format depth_format = vk::Format::eUndefined;  ///< undefined: no depth is written
    bool disc = false;                                 ///< of a resolve: with the direct disc
    bool in_gaze_frame = false;                        ///< of a log-polar map
    bool encode_srgb = false;   ///< the target's format does not encode by itself
    std::uint32_t samples = 1;  ///< a texel or pixel
};

/// A pipeline for dynamic rendering into one colour attachment and, if its shader writes depth, a
/// depth attachment that takes every value; viewport and scissor dynamic.
vk::raii::Pipeline make_pipeline(const vk::raii::Device& device,
                                 const vk::raii::PipelineLayout& layout,
                                 const PipelineSource& source);

}  // namespace gazeloop::vulkan
