#include "runtime/vulkan/raster_pipeline.h"

#include <array>
#include <vector>

#include "runtime/vulkan/shader_stage.h"

namespace gazeloop::vulkan {
vk::raii::Pipeline make_raster_pipeline(const vk::raii::Device& device,
                                        const vk::raii::PipelineLayout& layout,
                                        const RasterSource& source) {
    const Specialization constants(source.constants);
    const vk::SpecializationInfo specialization = constants.info();
    const vk::raii::ShaderModule vertex = load_shader(device, source.vertex);
    vk::raii::ShaderModule fragment{nullptr};
    std::vector<vk::PipelineShaderStageCreateInfo> stages{
        {{}, vk::ShaderStageFlagBits::eVertex, *vertex, "main"}};
    if (!source.fragment.empty()) {
        fragment = load_shader(device, source.fragment);
        stages.emplace_back(vk::PipelineShaderStageCreateFlags{},
                            vk::ShaderStageFlagBits::eFragment, *fragment, "main", &specialization);
    }
    const vk::VertexInputBindingDescription binding(0, source.stride, vk::VertexInputRate::eVertex);
    vk::PipelineVertexInputStateCreateInfo vertex_input;
    if (!source.attributes.empty()) {
        vertex_input.setVertexBindingDescriptions(binding);
        vertex_input.setVertexAttributeDescriptions(source.attributes);
    }
    const vk::PipelineInputAssemblyStateCreateInfo assembly({},
                                                            vk::PrimitiveTopology::eTriangleList);
    const vk::PipelineViewportStateCreateInfo viewport({}, 1, nullptr, 1, nullptr);
    const vk::PipelineRasterizationStateCreateInfo rasterization(
        {}, VK_FALSE, VK_FALSE, vk::PolygonMode::eFill, vk::CullModeFlagBits::eNone,
        vk::FrontFace::eCounterClockwise, VK_FALSE, 0.0F, 0.0F, 0.0F, 1.0F);
    const vk::PipelineMultisampleStateCreateInfo multisample;
    using Channel = vk::ColorComponentFlagBits;
    vk::PipelineColorBlendAttachmentState attachment;
    attachment.colorWriteMask = Channel::eR | Channel::eG | Channel::eB | Channel::eA;
    vk::PipelineColorBlendStateCreateInfo blend;
    vk::PipelineRenderingCreateInfo rendering(0, {}, source.depth_format);
    if (source.format != vk::Format::eUndefined) {
        blend.setAttachments(attachment);
        rendering.setColorAttachmentFormats(source.format);
    }
    const vk::PipelineDepthStencilStateCreateInfo depth_stencil(
        {}, source.depth_format != vk::Format::eUndefined, source.writes_depth, source.compare);
    const std::array dynamics{vk::DynamicState::eViewport, vk::DynamicState::eScissor,
                              vk::DynamicState::eCullMode, vk::DynamicState::eFrontFace};
    const vk::PipelineDynamicStateCreateInfo dynamic({}, dynamics);
    vk::GraphicsPipelineCreateInfo info({}, stages, &vertex_input, &assembly, nullptr, &viewport,
                                        &rasterization, &multisample, &depth_stencil, &blend,
                                        &dynamic, *layout);
    info.pNext = &rendering;
    return {device, nullptr, info};
}

}  // namespace gazeloop::vulkan
