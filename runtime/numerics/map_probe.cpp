#include "runtime/numerics/map_probe.h"

#include <cstring>

#include "runtime/vulkan/pipelines.h"
#include "shaders/shader_library.h"

namespace gazeloop::numerics {
namespace {

using Type = vk::DescriptorType;

constexpr std::uint32_t kGroupSize = 64;

/// Set 2: the map's uniforms, tables, columns and rows. Bands and LP-buffer are not needed: their
/// places hold the questions and the answers (shaders/numerics/map_probe.comp).
constexpr std::array kMapBindings{Type::eUniformBuffer, Type::eUniformBuffer, Type::eStorageBuffer,
                                  Type::eStorageBuffer, Type::eStorageBuffer, Type::eStorageBuffer};
constexpr std::array kFrameBindings{Type::eUniformBuffer};

}  // namespace

MapProbe::MapProbe(const vulkan::Context& context) : context_(&context) {
    const vk::raii::Device& device = context.device();
    constexpr auto kCompute = vk::ShaderStageFlagBits::eCompute;
    frame_layout_ = vulkan::make_set_layout(device, kFrameBindings, kCompute);
    empty_layout_ = vulkan::make_set_layout(device, {}, {});
    map_layout_ = vulkan::make_set_layout(device, kMapBindings, kCompute);
    layout_ =
        vulkan::make_pipeline_layout(device, {*frame_layout_, {}, *map_layout_}, *empty_layout_);
    const auto words = shaders::spirv("map_probe.comp");
    const vk::raii::ShaderModule module(
        device, vk::ShaderModuleCreateInfo({}, words.size_bytes(), words.data()));
    for (std::uint32_t in_gaze_frame = 0; in_gaze_frame < pipelines_.size(); ++in_gaze_frame) {
        const vk::SpecializationMapEntry entry(2, 0, sizeof in_gaze_frame);
        const vk::SpecializationInfo constants(1, &entry, sizeof in_gaze_frame, &in_gaze_frame);
        pipelines_[in_gaze_frame] = vk::raii::Pipeline(
            device, nullptr,
            vk::ComputePipelineCreateInfo(
                {},
                vk::PipelineShaderStageCreateInfo({}, vk::ShaderStageFlagBits::eCompute, *module,
                                                  "main", &constants),
                *layout_));
    }
}

std::vector<ProbeOutput> MapProbe::run(const render::MapBuffers& tables,
                                       const ProbeUniforms& uniforms, bool in_gaze_frame,
                                       std::span<const ProbeInput> inputs) const {
    /// As the shader writes it.
    struct Answer {
        glm::vec2 share;
        glm::vec2 ray_xy;
        glm::vec3 place;
        float ray_z;
    };
    const vk::raii::Device& device = context_->device();
    using Usage = vk::BufferUsageFlagBits;
    vulkan::HostBuffer frame_buffer(*context_, sizeof uniforms.frame, Usage::eUniformBuffer);
    frame_buffer.write(uniforms.frame);
    vulkan::HostBuffer map_buffer(*context_, sizeof uniforms.map, Usage::eUniformBuffer);
    map_buffer.write(uniforms.map);
    vulkan::HostBuffer input_buffer(*context_, inputs.size_bytes(), Usage::eStorageBuffer);
    input_buffer.write(inputs);
    const vulkan::HostBuffer output_buffer(*context_, inputs.size() * sizeof(Answer),
                                           Usage::eStorageBuffer);

    const std::array sizes{vk::DescriptorPoolSize(Type::eUniformBuffer, 3),
                           vk::DescriptorPoolSize(Type::eStorageBuffer, 4)};
    const vk::raii::DescriptorPool pool(
        device, vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
                                             2, sizes));
    const std::array layouts{*frame_layout_, *map_layout_};
    const vk::raii::DescriptorSets sets(device, vk::DescriptorSetAllocateInfo(*pool, layouts));
    const auto write = [&](vk::DescriptorSet set, std::uint32_t binding, Type type,
                           vk::Buffer buffer) {
        const vk::DescriptorBufferInfo info(buffer, 0, VK_WHOLE_SIZE);
        device.updateDescriptorSets(vk::WriteDescriptorSet(set, binding, 0, type, {}, info), {});
    };
    write(*sets[0], 0, kFrameBindings[0], frame_buffer.buffer());
    const std::array<vk::Buffer, kMapBindings.size()> buffers{
        map_buffer.buffer(), tables.map_tables(),   tables.column_table(),
        tables.row_table(),  input_buffer.buffer(), output_buffer.buffer()};
    for (std::uint32_t i = 0; i < kMapBindings.size(); ++i) {
        write(*sets[1], i, kMapBindings.at(i), buffers.at(i));
    }

    const vk::raii::CommandPool command_pool(
        device, vk::CommandPoolCreateInfo({}, context_->queue_family()));
    const vk::raii::CommandBuffers command_buffers(
        device, vk::CommandBufferAllocateInfo(*command_pool, vk::CommandBufferLevel::ePrimary, 1));
    const vk::raii::CommandBuffer& commands = command_buffers[0];
    commands.begin(vk::CommandBufferBeginInfo());
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipelines_[in_gaze_frame ? 1 : 0]);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, vulkan::kFrameSet,
                                *sets[0], {});
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, vulkan::kMethodSet,
                                *sets[1], {});
    commands.dispatch(static_cast<std::uint32_t>((inputs.size() + kGroupSize - 1) / kGroupSize), 1,
                      1);
    const vk::MemoryBarrier2 to_host(
        vk::PipelineStageFlagBits2::eComputeShader, vk::AccessFlagBits2::eShaderWrite,
        vk::PipelineStageFlagBits2::eHost, vk::AccessFlagBits2::eHostRead);
    commands.pipelineBarrier2(vk::DependencyInfo({}, to_host));
    commands.end();
    const vk::CommandBufferSubmitInfo submit(*commands);
    context_->queue().submit2(vk::SubmitInfo2({}, {}, submit));
    device.waitIdle();

    std::vector<ProbeOutput> outputs;
    outputs.reserve(inputs.size());
    const std::byte* const written = output_buffer.mapped().data();
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        Answer answer{};
        std::memcpy(&answer, written + i * sizeof answer, sizeof answer);
        outputs.push_back({answer.share, answer.place, {answer.ray_xy, answer.ray_z}});
    }
    return outputs;
}

}  // namespace gazeloop::numerics
