#include "runtime/numerics/map_probe.h"

#include <cstring>
#include <tuple>

#include "runtime/vulkan/pipelines.h"
#include "shaders/shader_library.h"

namespace gazeloop::numerics {
namespace {

using Type = vk::DescriptorType;

constexpr std::uint32_t kInputsBinding = 6;
constexpr std::uint32_t kOutputsBinding = 7;
constexpr std::uint32_t kGroupSize = 64;

constexpr std::array kBindings{
    std::pair{std::uint32_t{vulkan::kEyeUniformsBinding}, Type::eUniformBuffer},
    std::pair{std::uint32_t{vulkan::kMapTablesBinding}, Type::eUniformBuffer},
    std::pair{std::uint32_t{vulkan::kColumnTableBinding}, Type::eStorageBuffer},
    std::pair{std::uint32_t{vulkan::kRowTableBinding}, Type::eStorageBuffer},
    std::pair{kInputsBinding, Type::eStorageBuffer},
    std::pair{kOutputsBinding, Type::eStorageBuffer}};

}  // namespace

MapProbe::MapProbe(const vulkan::Context& context) : context_(&context) {
    const vk::raii::Device& device = context.device();
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    bindings.reserve(kBindings.size());
    for (const auto& [binding, type] : kBindings) {
        bindings.emplace_back(binding, type, 1, vk::ShaderStageFlagBits::eCompute);
    }
    set_layout_ =
        vk::raii::DescriptorSetLayout(device, vk::DescriptorSetLayoutCreateInfo({}, bindings));
    layout_ = vk::raii::PipelineLayout(device, vk::PipelineLayoutCreateInfo({}, *set_layout_));
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
                                       const render::EyeUniforms& uniforms, bool in_gaze_frame,
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
    vulkan::HostBuffer uniform_buffer(*context_, sizeof uniforms, Usage::eUniformBuffer);
    uniform_buffer.write(uniforms);
    vulkan::HostBuffer input_buffer(*context_, inputs.size_bytes(), Usage::eStorageBuffer);
    input_buffer.write(inputs);
    const vulkan::HostBuffer output_buffer(*context_, inputs.size() * sizeof(Answer),
                                           Usage::eStorageBuffer);

    const std::array sizes{vk::DescriptorPoolSize(Type::eUniformBuffer, 2),
                           vk::DescriptorPoolSize(Type::eStorageBuffer, 4)};
    const vk::raii::DescriptorPool pool(
        device, vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
                                             1, sizes));
    const vk::raii::DescriptorSets sets(device, vk::DescriptorSetAllocateInfo(*pool, *set_layout_));
    const std::array<vk::Buffer, kBindings.size()> buffers{
        uniform_buffer.buffer(), tables.map_tables(),   tables.column_table(),
        tables.row_table(),      input_buffer.buffer(), output_buffer.buffer()};
    for (std::size_t i = 0; i < kBindings.size(); ++i) {
        const vk::DescriptorBufferInfo info(buffers[i], 0, VK_WHOLE_SIZE);
        device.updateDescriptorSets(
            vk::WriteDescriptorSet(*sets[0], kBindings[i].first, 0, kBindings[i].second, {}, info),
            {});
    }

    const vk::raii::CommandPool command_pool(
        device, vk::CommandPoolCreateInfo({}, context_->queue_family()));
    const vk::raii::CommandBuffers command_buffers(
        device, vk::CommandBufferAllocateInfo(*command_pool, vk::CommandBufferLevel::ePrimary, 1));
    const vk::raii::CommandBuffer& commands = command_buffers[0];
    commands.begin(vk::CommandBufferBeginInfo());
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipelines_[in_gaze_frame ? 1 : 0]);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, 0, *sets[0], {});
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
