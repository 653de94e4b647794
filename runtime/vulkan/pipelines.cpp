#include "runtime/vulkan/pipelines.h"

#include <array>

#include "shaders/shader_library.h"

namespace gazeloop::vulkan {
namespace {

vk::raii::ShaderModule load(const vk::raii::Device& device, std::string_view name) {
    const auto words = shaders::spirv(name);
    return {device, vk::ShaderModuleCreateInfo({}, words.size_bytes(), words.data())};
}

}  // namespace

vk::raii::DescriptorSetLayout make_set_layout(const vk::raii::Device& device, Inputs inputs) {
    using Type = vk::DescriptorType;
    constexpr auto kFragment = vk::ShaderStageFlagBits::eFragment;
    const std::array bindings{
        vk::DescriptorSetLayoutBinding(kEyeUniformsBinding, Type::eUniformBuffer, 1, kFragment),
        vk::DescriptorSetLayoutBinding(kMapTablesBinding, Type::eUniformBuffer, 1, kFragment),
        vk::DescriptorSetLayoutBinding(kColumnTableBinding, Type::eStorageBuffer, 1, kFragment),
        vk::DescriptorSetLayoutBinding(kRowTableBinding, Type::eStorageBuffer, 1, kFragment),
        vk::DescriptorSetLayoutBinding(kBandsBinding, Type::eStorageBuffer, 1, kFragment),
        vk::DescriptorSetLayoutBinding(kLpBufferBinding, Type::eCombinedImageSampler, 1, kFragment),
        vk::DescriptorSetLayoutBinding(kDirectBufferBinding, Type::eCombinedImageSampler, 1,
                                       kFragment),
    };
    const std::uint32_t count = inputs == Inputs::Uniforms ? 1 : bindings.size();
    return {device, vk::DescriptorSetLayoutCreateInfo({}, count, bindings.data())};
}

vk::raii::PipelineLayout make_pipeline_layout(const vk::raii::Device& device,
                                              const vk::raii::DescriptorSetLayout& set_layout) {
    return {device, vk::PipelineLayoutCreateInfo({}, *set_layout)};
}

vk::raii::Pipeline make_pipeline(const vk::raii::Device& device,
                                 const vk::raii::PipelineLayout& layout,
                                 const PipelineSource& source) {
    const vk::raii::ShaderModule vertex = load(device, source.vertex);
    const vk::raii::ShaderModule fragment = load(device, source.fragment);
    // constant_id 0: kEncodeSrgb, 1: kSamples, 2: kInGazeFrame, 3: kDisc.
    const std::array<std::uint32_t, 4> constants{source.encode_srgb ? 1U : 0U, source.samples,
                                                 source.in_gaze_frame ? 1U : 0U,
                                                 source.disc ? 1U : 0U};
    const std::array entries{
        vk::SpecializationMapEntry(0, 0, sizeof(std::uint32_t)),
        vk::SpecializationMapEntry(1, sizeof(std::uint32_t), sizeof(std::uint32_t)),
        vk::SpecializationMapEntry(2, 2 * sizeof(std::uint32_t), sizeof(std::uint32_t)),
        vk::SpecializationMapEntry(3, 3 * sizeof(std::uint32_t), sizeof(std::uint32_t))};
    const vk::SpecializationInfo specialization(entries.size(), entries.data(), sizeof constants,
                                                constants.data());
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
