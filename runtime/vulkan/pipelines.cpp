#include "runtime/vulkan/pipelines.h"

#include <array>
#include <vector>

#include "runtime/vulkan/shader_stage.h"

namespace gazeloop::vulkan {
vk::raii::DescriptorSetLayout make_set_layout(const vk::raii::Device& device,
                                              std::span<const vk::DescriptorType> bindings,
                                              vk::ShaderStageFlags stages) {
    std::vector<vk::DescriptorSetLayoutBinding> stated;
    stated.reserve(bindings.size());
    for (const vk::DescriptorType type : bindings) {
        stated.emplace_back(static_cast<std::uint32_t>(stated.size()), type, 1, stages);
    }
    return {device, vk::DescriptorSetLayoutCreateInfo({}, stated)};
}

vk::raii::PipelineLayout make_pipeline_layout(const vk::raii::Device& device,
                                              std::array<vk::DescriptorSetLayout, 3> sets,
                                              vk::DescriptorSetLayout empty) {
    for (vk::DescriptorSetLayout& set : sets) {
        set = set ? set : empty;
    }
    return {device, vk::PipelineLayoutCreateInfo({}, sets)};
}

vk::raii::Pipeline make_pipeline(const vk::raii::Device& device,
                                 const vk::raii::PipelineLayout& layout,
                                 const PipelineSource& source) {
    const vk::raii::ShaderModule vertex = load_shader(device, source.vertex);
    const vk::raii::ShaderModule fragment = load_shader(device, source.fragment);
    const Specialization constants(source.constants);
    const vk::SpecializationInfo specialization = constants.info();
    const std::array stages{
        vk::PipelineShaderStageCreateInfo({}, vk::ShaderStageFlagBits::eVertex, *vertex, "main"),
        vk::PipelineShaderStageCreateInfo({}, vk::ShaderStageFlagBits::eFragment, *fragment, "main",
                                          &specialization)};
    const vk::PipelineVertexInputStateCreateInfo vertex_input;
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
    const vk::PipelineColorBlendStateCreateInfo blend({}, VK_FALSE, vk::LogicOp::eCopy, attachment);
    const bool depth = source.depth_format != vk::Format::eUndefined;
    const vk::PipelineDepthStencilStateCreateInfo depth_stencil({}, depth, depth,
                                                                vk::CompareOp::eAlways);
    const std::array dynamics{vk::DynamicState::eViewport, vk::DynamicState::eScissor};
    const vk::PipelineDynamicStateCreateInfo dynamic({}, dynamics);
    const vk::PipelineRenderingCreateInfo rendering(0, source.format, source.depth_format);
    vk::GraphicsPipelineCreateInfo info({}, stages, &vertex_input, &assembly, nullptr, &viewport,
                                        &rasterization, &multisample, &depth_stencil, &blend,
                                        &dynamic, *layout);
    info.pNext = &rendering;
    return {device, nullptr, info};
}

}  // namespace gazeloop::vulkan
