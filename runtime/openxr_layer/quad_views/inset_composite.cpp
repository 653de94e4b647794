#include "runtime/openxr_layer/quad_views/inset_composite.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <ranges>
#include <stdexcept>
#include <string>
#include <utility>

namespace gazeloop::openxr_layer {
namespace {

constexpr std::uint32_t kVertexShader[] = {
#include "full_screen.vert.inc"
};
constexpr std::uint32_t kFragmentShader[] = {
#include "inset.frag.inc"
};

/// std140: Composite in shaders/layer/inset.frag.
struct Uniforms {
    std::array<float, 4> outer_part;
    std::array<float, 4> outer_least;
    std::array<float, 4> inset_part;
    std::array<float, 4> inset_least;
    std::array<float, 4> covers;
    std::array<float, 4> blend;
    std::array<float, 4> size;
};
/// What every device takes as the place of a uniform buffer.
constexpr VkDeviceSize kUniformStride = 256;
static_assert(sizeof(Uniforms) <= kUniformStride);

void check(VkResult result, const char* call) {
    if (result != VK_SUCCESS) {
        throw std::runtime_error(fmt::format("{}: VkResult {}", call, static_cast<int>(result)));
    }
}

template <typename Structure>
Structure made(VkStructureType type) {
    Structure structure{};
    structure.sType = type;
    return structure;
}

std::array<float, 4> floats(double a, double b, double c, double d) {
    return {static_cast<float>(a), static_cast<float>(b), static_cast<float>(c),
            static_cast<float>(d)};
}

/// A picture's rectangle in texture coordinates, and what of them may be read: half a texel inside.
void place(const GivenPicture& picture, std::array<float, 4>& part, std::array<float, 4>& least) {
    const double width = picture.texture.width_px;
    const double height = picture.texture.height_px;
    const double x = picture.rect.offset.x;
    const double y = picture.rect.offset.y;
    const double w = picture.rect.extent.width;
    const double h = picture.rect.extent.height;
    part = floats(x / width, y / height, w / width, h / height);
    least = floats((x + 0.5) / width, (y + 0.5) / height, (x + w - 0.5) / width,
                   (y + h - 0.5) / height);
}

Uniforms uniforms_of(const CompositedEye& eye, const PictureSize& size, double blend) {
    Uniforms uniforms{};
    place(eye.outer, uniforms.outer_part, uniforms.outer_least);
    place(eye.inset, uniforms.inset_part, uniforms.inset_least);
    const double width = size.width_px;
    const double height = size.height_px;
    const PicturePart& part = eye.covers;
    uniforms.covers =
        floats(part.x * width, part.y * height, part.width * width, part.height * height);
    uniforms.size = floats(width, height, 0.0, 0.0);
    // At the picture's edges there is nothing to blend with.
    constexpr double kAtOnce = 1e6;
    constexpr double kAtEdge = 1e-4;
    const auto per_px = [&](double side_px, double gap) {
        const double band_px = 0.5 * blend * side_px;
        return gap < kAtEdge || band_px < 1e-3 ? kAtOnce : 1.0 / band_px;
    };
    uniforms.blend =
        floats(per_px(part.width * width, part.x), per_px(part.height * height, part.y),
               per_px(part.width * width, 1.0 - part.x - part.width),
               per_px(part.height * height, 1.0 - part.y - part.height));
    return uniforms;
}

std::uint32_t host_memory(const VkPhysicalDeviceMemoryProperties& memory, std::uint32_t mask) {
    constexpr VkMemoryPropertyFlags kWanted =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    for (std::uint32_t type = 0; type < memory.memoryTypeCount; ++type) {
        if ((mask >> type & 1U) != 0 &&
            (memory.memoryTypes[type].propertyFlags & kWanted) == kWanted) {
            return type;
        }
    }
    throw std::runtime_error("no memory of the device can be written by the processor");
}

}  // namespace

Expected<std::unique_ptr<InsetComposite>> InsetComposite::create(const ApplicationDevice& device) {
    auto functions = VulkanFunctions::of(device.instance, device.device);
    if (!functions) {
        return std::unexpected(std::move(functions.error()));
    }
    std::unique_ptr<InsetComposite> composite(new InsetComposite(device, *functions));
    composite->make_layout();
    composite->make_uniforms();
    composite->make_slots();
    return composite;
}

InsetComposite::InsetComposite(const ApplicationDevice& device, const VulkanFunctions& vk)
    : device_(device), vk_(vk) {
    vk_.GetDeviceQueue(device_.device, device_.queue_family, device_.queue_index, &queue_);
    std::uint32_t count = 0;
    vk_.GetPhysicalDeviceQueueFamilyProperties(device_.physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vk_.GetPhysicalDeviceQueueFamilyProperties(device_.physical, &count, families.data());
    VkPhysicalDeviceProperties properties{};
    vk_.GetPhysicalDeviceProperties(device_.physical, &properties);
    const std::uint32_t bits =
        device_.queue_family < count ? families[device_.queue_family].timestampValidBits : 0;
    if (bits > 0) {
        timestamp_ns_ = properties.limits.timestampPeriod;
        timestamp_mask_ =
            bits >= 64 ? std::numeric_limits<std::uint64_t>::max() : (std::uint64_t{1} << bits) - 1;
    }
}

InsetComposite::~InsetComposite() {
    try {
        wait_for_all();
    } catch (...) {  // NOLINT(bugprone-empty-catch)
        // The device is lost: its objects may go.
    }
    for (const auto& [key, view] : views_) {
        vk_.DestroyImageView(device_.device, view, nullptr);
    }
    for (const auto& [image, framebuffer] : framebuffers_) {
        vk_.DestroyFramebuffer(device_.device, framebuffer, nullptr);
    }
    for (const auto& [format, pipeline] : pipelines_) {
        vk_.DestroyPipeline(device_.device, pipeline, nullptr);
    }
    for (const auto& [format, pass] : passes_) {
        vk_.DestroyRenderPass(device_.device, pass, nullptr);
    }
    for (const std::function<void()>& undo : std::views::reverse(undo_)) {
        undo();
    }
}

void InsetComposite::make_layout() {
    std::array<VkDescriptorSetLayoutBinding, 3> bindings{};
    for (std::uint32_t i = 0; i < bindings.size(); ++i) {
        bindings[i] = {.binding = i,
                       .descriptorType = i == 0 ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER
                                                : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                       .descriptorCount = 1,
                       .stageFlags = VK_SHADER_STAGE_FRAGMENT_BIT,
                       .pImmutableSamplers = nullptr};
    }
    auto sets =
        made<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
    sets.bindingCount = static_cast<std::uint32_t>(bindings.size());
    sets.pBindings = bindings.data();
    check(vk_.CreateDescriptorSetLayout(device_.device, &sets, nullptr, &set_layout_),
          "vkCreateDescriptorSetLayout");
    undo_.emplace_back(
        [this] { vk_.DestroyDescriptorSetLayout(device_.device, set_layout_, nullptr); });
    auto layout = made<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    layout.setLayoutCount = 1;
    layout.pSetLayouts = &set_layout_;
    check(vk_.CreatePipelineLayout(device_.device, &layout, nullptr, &layout_),
          "vkCreatePipelineLayout");
    undo_.emplace_back([this] { vk_.DestroyPipelineLayout(device_.device, layout_, nullptr); });
    auto sampler = made<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
    sampler.magFilter = sampler.minFilter = VK_FILTER_LINEAR;
    sampler.addressModeU = sampler.addressModeV = sampler.addressModeW =
        VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    check(vk_.CreateSampler(device_.device, &sampler, nullptr, &sampler_), "vkCreateSampler");
    undo_.emplace_back([this] { vk_.DestroySampler(device_.device, sampler_, nullptr); });
}

void InsetComposite::make_uniforms() {
    auto buffer = made<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
    buffer.size = kUniformStride * kFrames * gaze::kEyeCount;
    buffer.usage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT;
    check(vk_.CreateBuffer(device_.device, &buffer, nullptr, &uniforms_), "vkCreateBuffer");
    undo_.emplace_back([this] { vk_.DestroyBuffer(device_.device, uniforms_, nullptr); });
    VkMemoryRequirements needs{};
    vk_.GetBufferMemoryRequirements(device_.device, uniforms_, &needs);
    VkPhysicalDeviceMemoryProperties memory{};
    vk_.GetPhysicalDeviceMemoryProperties(device_.physical, &memory);
    auto allocate = made<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
    allocate.allocationSize = needs.size;
    allocate.memoryTypeIndex = host_memory(memory, needs.memoryTypeBits);
    VkDeviceMemory held = VK_NULL_HANDLE;
    check(vk_.AllocateMemory(device_.device, &allocate, nullptr, &held), "vkAllocateMemory");
    undo_.emplace_back([this, held] { vk_.FreeMemory(device_.device, held, nullptr); });
    check(vk_.BindBufferMemory(device_.device, uniforms_, held, 0), "vkBindBufferMemory");
    void* mapped = nullptr;
    check(vk_.MapMemory(device_.device, held, 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory");
    mapped_ = static_cast<std::byte*>(mapped);
}

void InsetComposite::make_slots() {
    auto pool = made<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = device_.queue_family;
    VkCommandPool commands = VK_NULL_HANDLE;
    check(vk_.CreateCommandPool(device_.device, &pool, nullptr, &commands), "vkCreateCommandPool");
    undo_.emplace_back(
        [this, commands] { vk_.DestroyCommandPool(device_.device, commands, nullptr); });
    constexpr auto kSets = static_cast<std::uint32_t>(kFrames * gaze::kEyeCount);
    const std::array<VkDescriptorPoolSize, 2> sizes{
        {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kSets},
         {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 2 * kSets}}};
    auto descriptors =
        made<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    descriptors.maxSets = kSets;
    descriptors.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    descriptors.pPoolSizes = sizes.data();
    VkDescriptorPool sets = VK_NULL_HANDLE;
    check(vk_.CreateDescriptorPool(device_.device, &descriptors, nullptr, &sets),
          "vkCreateDescriptorPool");
    undo_.emplace_back([this, sets] { vk_.DestroyDescriptorPool(device_.device, sets, nullptr); });
    if (timestamp_ns_ > 0.0) {
        auto queries = made<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
        queries.queryType = VK_QUERY_TYPE_TIMESTAMP;
        queries.queryCount = 2 * kFrames;
        check(vk_.CreateQueryPool(device_.device, &queries, nullptr, &queries_),
              "vkCreateQueryPool");
        undo_.emplace_back([this] { vk_.DestroyQueryPool(device_.device, queries_, nullptr); });
    }
    for (Slot& slot : slots_) {
        auto buffer =
            made<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
        buffer.commandPool = commands;
        buffer.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
        buffer.commandBufferCount = 1;
        check(vk_.AllocateCommandBuffers(device_.device, &buffer, &slot.commands),
              "vkAllocateCommandBuffers");
        const auto fence = made<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
        check(vk_.CreateFence(device_.device, &fence, nullptr, &slot.fence), "vkCreateFence");
        undo_.emplace_back(
            [this, used = slot.fence] { vk_.DestroyFence(device_.device, used, nullptr); });
        const gaze::PerEye<VkDescriptorSetLayout> layouts{set_layout_, set_layout_};
        auto allocate =
            made<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
        allocate.descriptorPool = sets;
        allocate.descriptorSetCount = static_cast<std::uint32_t>(layouts.size());
        allocate.pSetLayouts = layouts.data();
        check(vk_.AllocateDescriptorSets(device_.device, &allocate, slot.sets.data()),
              "vkAllocateDescriptorSets");
    }
}

void InsetComposite::finish(Slot& slot) {
    if (!slot.under_way) {
        return;
    }
    constexpr std::uint64_t kPatience_ns = 5'000'000'000;
    check(vk_.WaitForFences(device_.device, 1, &slot.fence, VK_TRUE, kPatience_ns),
          "vkWaitForFences");
    check(vk_.ResetFences(device_.device, 1, &slot.fence), "vkResetFences");
    const auto index = static_cast<std::size_t>(&slot - slots_.data());
    std::array<std::uint64_t, 2> ticks{};
    if (queries_ != VK_NULL_HANDLE &&
        vk_.GetQueryPoolResults(device_.device, queries_, static_cast<std::uint32_t>(2 * index), 2,
                                sizeof ticks, ticks.data(), sizeof ticks[0],
                                VK_QUERY_RESULT_64_BIT) == VK_SUCCESS) {
        timed_[index] = Timed{
            *slot.under_way,
            static_cast<std::int64_t>(static_cast<double>((ticks[1] - ticks[0]) & timestamp_mask_) *
                                      timestamp_ns_)};
    }
    slot.under_way.reset();
}

void InsetComposite::wait_for_all() {
    for (Slot& slot : slots_) {
        finish(slot);
    }
}

std::optional<InsetComposite::Timed> InsetComposite::take_timed() {
    for (std::optional<Timed>& timed : timed_) {
        if (timed) {
            return std::exchange(timed, std::nullopt);
        }
    }
    return std::nullopt;
}

VkImageView InsetComposite::view_of(VkImage image, VkFormat format, std::uint32_t layer) {
    VkImageView& view = views_[{image, format, layer}];
    if (view == VK_NULL_HANDLE) {
        auto info = made<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
        info.image = image;
        info.viewType = VK_IMAGE_VIEW_TYPE_2D;
        info.format = format;
        info.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, layer, 1};
        check(vk_.CreateImageView(device_.device, &info, nullptr, &view), "vkCreateImageView");
    }
    return view;
}

VkRenderPass InsetComposite::pass_of(VkFormat format) {
    VkRenderPass& pass = passes_[format];
    if (pass == VK_NULL_HANDLE) {
        const VkAttachmentDescription target{
            .flags = 0,
            .format = format,
            .samples = VK_SAMPLE_COUNT_1_BIT,
            .loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
            .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
            .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
            .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
            .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED,
            .finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
        const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
        VkSubpassDescription subpass{};
        subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
        subpass.colorAttachmentCount = 1;
        subpass.pColorAttachments = &reference;
        const VkSubpassDependency dependency{
            .srcSubpass = VK_SUBPASS_EXTERNAL,
            .dstSubpass = 0,
            .srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
            .dstStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
            .srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
            .dstAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
            .dependencyFlags = 0};
        auto info = made<VkRenderPassCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO);
        info.attachmentCount = 1;
        info.pAttachments = &target;
        info.subpassCount = 1;
        info.pSubpasses = &subpass;
        info.dependencyCount = 1;
        info.pDependencies = &dependency;
        check(vk_.CreateRenderPass(device_.device, &info, nullptr, &pass), "vkCreateRenderPass");
    }
    return pass;
}

VkShaderModule InsetComposite::shader(const std::uint32_t* words, std::size_t bytes) {
    auto info = made<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    info.codeSize = bytes;
    info.pCode = words;
    VkShaderModule module = VK_NULL_HANDLE;
    check(vk_.CreateShaderModule(device_.device, &info, nullptr, &module), "vkCreateShaderModule");
    undo_.emplace_back(
        [this, module] { vk_.DestroyShaderModule(device_.device, module, nullptr); });
    return module;
}

VkPipeline InsetComposite::pipeline_of(VkFormat format) {
    VkPipeline& pipeline = pipelines_[format];
    if (pipeline != VK_NULL_HANDLE) {
        return pipeline;
    }
    std::array<VkPipelineShaderStageCreateInfo, 2> stages{};
    for (VkPipelineShaderStageCreateInfo& stage : stages) {
        stage = made<VkPipelineShaderStageCreateInfo>(
            VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
        stage.pName = "main";
    }
    stages[0].stage = VK_SHADER_STAGE_VERTEX_BIT;
    stages[0].module = shader(kVertexShader, sizeof kVertexShader);
    stages[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
    stages[1].module = shader(kFragmentShader, sizeof kFragmentShader);
    const auto vertices = made<VkPipelineVertexInputStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
    auto assembly = made<VkPipelineInputAssemblyStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    auto viewport = made<VkPipelineViewportStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO);
    viewport.viewportCount = viewport.scissorCount = 1;
    auto raster = made<VkPipelineRasterizationStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO);
    raster.lineWidth = 1.0F;
    auto samples = made<VkPipelineMultisampleStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    VkPipelineColorBlendAttachmentState written{};
    written.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                             VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    auto blend = made<VkPipelineColorBlendStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
    blend.attachmentCount = 1;
    blend.pAttachments = &written;
    const std::array dynamic{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    auto states = made<VkPipelineDynamicStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO);
    states.dynamicStateCount = static_cast<std::uint32_t>(dynamic.size());
    states.pDynamicStates = dynamic.data();
    auto info = made<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO);
    info.stageCount = static_cast<std::uint32_t>(stages.size());
    info.pStages = stages.data();
    info.pVertexInputState = &vertices;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pColorBlendState = &blend;
    info.pDynamicState = &states;
    info.layout = layout_;
    info.renderPass = pass_of(format);
    check(vk_.CreateGraphicsPipelines(device_.device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
          "vkCreateGraphicsPipelines");
    return pipeline;
}

VkFramebuffer InsetComposite::framebuffer_of(VkImage image, VkFormat format,
                                             const PictureSize& size) {
    VkFramebuffer& framebuffer = framebuffers_[image];
    if (framebuffer == VK_NULL_HANDLE) {
        const VkImageView view = view_of(image, format, 0);
        auto info = made<VkFramebufferCreateInfo>(VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO);
        info.renderPass = pass_of(format);
        info.attachmentCount = 1;
        info.pAttachments = &view;
        info.width = size.width_px;
        info.height = size.height_px;
        info.layers = 1;
        check(vk_.CreateFramebuffer(device_.device, &info, nullptr, &framebuffer),
              "vkCreateFramebuffer");
    }
    return framebuffer;
}

void InsetComposite::forget(VkImage image) {
    wait_for_all();
    if (const auto found = framebuffers_.find(image); found != framebuffers_.end()) {
        vk_.DestroyFramebuffer(device_.device, found->second, nullptr);
        framebuffers_.erase(found);
    }
    std::erase_if(views_, [&](const auto& one) {
        const bool is_of_it = std::get<0>(one.first) == image;
        if (is_of_it) {
            vk_.DestroyImageView(device_.device, one.second, nullptr);
        }
        return is_of_it;
    });
}

void InsetComposite::bind(std::size_t slot, std::size_t eye, const CompositedEye& composited,
                          const PictureSize& size, double blend) {
    const VkDeviceSize offset = kUniformStride * (slot * gaze::kEyeCount + eye);
    const Uniforms uniforms = uniforms_of(composited, size, blend);
    std::memcpy(mapped_ + offset, &uniforms, sizeof uniforms);
    const VkDescriptorBufferInfo buffer{uniforms_, offset, sizeof uniforms};
    const auto image = [&](const GivenPicture& picture) {
        return VkDescriptorImageInfo{sampler_,
                                     view_of(picture.image, picture.format, picture.array_layer),
                                     VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    };
    const std::array images{image(composited.outer), image(composited.inset)};
    std::array<VkWriteDescriptorSet, 3> writes{};
    for (std::uint32_t i = 0; i < writes.size(); ++i) {
        writes[i] = made<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
        writes[i].dstSet = slots_[slot].sets[eye];
        writes[i].dstBinding = i;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType =
            i == 0 ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
        writes[i].pBufferInfo = i == 0 ? &buffer : nullptr;
        writes[i].pImageInfo = i == 0 ? nullptr : &images[i - 1];
    }
    vk_.UpdateDescriptorSets(device_.device, static_cast<std::uint32_t>(writes.size()),
                             writes.data(), 0, nullptr);
}

void InsetComposite::record(std::size_t slot, const gaze::PerEye<CompositedEye>& eyes,
                            const PictureSize& size, VkFormat format) {
    const VkCommandBuffer commands = slots_[slot].commands;
    auto begin = made<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vk_.BeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
    const auto query = static_cast<std::uint32_t>(2 * slot);
    if (queries_ != VK_NULL_HANDLE) {
        vk_.CmdResetQueryPool(commands, queries_, query, 2);
        vk_.CmdWriteTimestamp(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, queries_, query);
    }
    // Several pictures may be of one image.
    std::array<VkImageMemoryBarrier, 2 * gaze::kEyeCount> barriers{};
    std::uint32_t count = 0;
    for (const CompositedEye& eye : eyes) {
        for (const VkImage image : {eye.outer.image, eye.inset.image}) {
            const auto end = barriers.begin() + count;
            if (std::find_if(barriers.begin(), end, [image](const VkImageMemoryBarrier& one) {
                    return one.image == image;
                }) != end) {
                continue;
            }
            VkImageMemoryBarrier& barrier = barriers[count++];
            barrier = made<VkImageMemoryBarrier>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER);
            barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
            barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT;
            barrier.oldLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
            barrier.newLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
            barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
            barrier.image = image;
            barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_REMAINING_MIP_LEVELS, 0,
                                        VK_REMAINING_ARRAY_LAYERS};
        }
    }
    vk_.CmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                           VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, 0, 0, nullptr, 0, nullptr, count,
                           barriers.data());
    const VkPipeline pipeline = pipeline_of(format);
    const VkRect2D whole{{0, 0}, {size.width_px, size.height_px}};
    const VkViewport viewport{
        0.0F, 0.0F, static_cast<float>(size.width_px), static_cast<float>(size.height_px),
        0.0F, 1.0F};
    for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
        auto pass = made<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
        pass.renderPass = pass_of(format);
        pass.framebuffer = framebuffer_of(eyes[eye].target, format, size);
        pass.renderArea = whole;
        vk_.CmdBeginRenderPass(commands, &pass, VK_SUBPASS_CONTENTS_INLINE);
        vk_.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
        vk_.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1,
                                  &slots_[slot].sets[eye], 0, nullptr);
        vk_.CmdSetViewport(commands, 0, 1, &viewport);
        vk_.CmdSetScissor(commands, 0, 1, &whole);
        vk_.CmdDraw(commands, 3, 1, 0, 0);
        vk_.CmdEndRenderPass(commands);
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        std::swap(barriers[i].oldLayout, barriers[i].newLayout);
        barriers[i].srcAccessMask = 0;
        barriers[i].dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    }
    vk_.CmdPipelineBarrier(commands, VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT,
                           VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, nullptr, 0, nullptr, count,
                           barriers.data());
    if (queries_ != VK_NULL_HANDLE) {
        vk_.CmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, queries_, query + 1);
    }
    check(vk_.EndCommandBuffer(commands), "vkEndCommandBuffer");
}

void InsetComposite::draw(const gaze::PerEye<CompositedEye>& eyes, const PictureSize& size,
                          VkFormat format, double blend) {
    const std::size_t index = drawn_ % kFrames;
    Slot& slot = slots_[index];
    finish(slot);
    for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
        bind(index, eye, eyes[eye], size, blend);
    }
    record(index, eyes, size, format);
    auto submit = made<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &slot.commands;
    check(vk_.QueueSubmit(queue_, 1, &submit, slot.fence), "vkQueueSubmit");
    slot.under_way = drawn_++;
}

}  // namespace gazeloop::openxr_layer
