#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vulkan/vulkan_raii.hpp>

#include "runtime/vulkan/pipelines.h"

namespace gazeloop::vulkan {

/// A pipeline that draws triangles with a depth test, for dynamic rendering. Viewport, scissor,
/// cull mode and front face are dynamic.
struct RasterSource {
    std::string_view vertex;      ///< names as shaders::spirv takes them
    std::string_view fragment{};  ///< empty: depth alone
    std::span<const vk::VertexInputAttributeDescription> attributes{};  ///< all of binding 0
    std::uint32_t stride = 0;
    vk::Format format = vk::Format::eUndefined;  ///< undefined: depth alone
    vk::Format depth_format = vk::Format::eUndefined;
    vk::CompareOp compare = vk::CompareOp::eGreater;  ///< of what is drawn with what is there
    bool writes_depth = true;
    std::span<const ShaderConstant> constants{};  ///< of the fragment shader
};

vk::raii::Pipeline make_raster_pipeline(const vk::raii::Device& device,
                                        const vk::raii::PipelineLayout& layout,
                                        const RasterSource& source);

}  // namespace gazeloop::vulkan
