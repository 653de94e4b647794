#pragma once

#include <vulkan/vulkan.h>

#include "runtime/error.h"

namespace gazeloop::openxr_layer {

/// Every function of Vulkan 1.0 that the layer calls on an application's device.
#define GAZELOOP_LAYER_VULKAN(FUNCTION)   \
    FUNCTION(AllocateCommandBuffers)      \
    FUNCTION(AllocateDescriptorSets)      \
    FUNCTION(AllocateMemory)              \
    FUNCTION(BeginCommandBuffer)          \
    FUNCTION(BindBufferMemory)            \
    FUNCTION(CmdBeginRenderPass)          \
    FUNCTION(CmdBindDescriptorSets)       \
    FUNCTION(CmdBindPipeline)             \
    FUNCTION(CmdDraw)                     \
    FUNCTION(CmdEndRenderPass)            \
    FUNCTION(CmdPipelineBarrier)          \
    FUNCTION(CmdResetQueryPool)           \
    FUNCTION(CmdSetScissor)               \
    FUNCTION(CmdSetViewport)              \
    FUNCTION(CmdWriteTimestamp)           \
    FUNCTION(CreateBuffer)                \
    FUNCTION(CreateCommandPool)           \
    FUNCTION(CreateDescriptorPool)        \
    FUNCTION(CreateDescriptorSetLayout)   \
    FUNCTION(CreateFence)                 \
    FUNCTION(CreateFramebuffer)           \
    FUNCTION(CreateGraphicsPipelines)     \
    FUNCTION(CreateImageView)             \
    FUNCTION(CreatePipelineLayout)        \
    FUNCTION(CreateQueryPool)             \
    FUNCTION(CreateRenderPass)            \
    FUNCTION(CreateSampler)               \
    FUNCTION(CreateShaderModule)          \
    FUNCTION(DestroyBuffer)               \
    FUNCTION(DestroyCommandPool)          \
    FUNCTION(DestroyDescriptorPool)       \
    FUNCTION(DestroyDescriptorSetLayout)  \
    FUNCTION(DestroyFence)                \
    FUNCTION(DestroyFramebuffer)          \
    FUNCTION(DestroyImageView)            \
    FUNCTION(DestroyPipeline)             \
    FUNCTION(DestroyPipelineLayout)       \
    FUNCTION(DestroyQueryPool)            \
    FUNCTION(DestroyRenderPass)           \
    FUNCTION(DestroySampler)              \
    FUNCTION(DestroyShaderModule)         \
    FUNCTION(EndCommandBuffer)            \
    FUNCTION(FreeMemory)                  \
    FUNCTION(GetBufferMemoryRequirements) \
    FUNCTION(GetDeviceQueue)              \
    FUNCTION(GetQueryPoolResults)         \
    FUNCTION(MapMemory)                   \
    FUNCTION(QueueSubmit)                 \
    FUNCTION(ResetFences)                 \
    FUNCTION(UpdateDescriptorSets)        \
    FUNCTION(WaitForFences)

/// Of an application's device. The layer links no Vulkan: the loader, which the application has
/// loaded, is asked for.
struct VulkanFunctions {
#define GAZELOOP_LAYER_MEMBER(name) PFN_vk##name name = nullptr;
    GAZELOOP_LAYER_VULKAN(GAZELOOP_LAYER_MEMBER)
#undef GAZELOOP_LAYER_MEMBER
    PFN_vkGetPhysicalDeviceMemoryProperties GetPhysicalDeviceMemoryProperties = nullptr;
    PFN_vkGetPhysicalDeviceProperties GetPhysicalDeviceProperties = nullptr;
    PFN_vkGetPhysicalDeviceQueueFamilyProperties GetPhysicalDeviceQueueFamilyProperties = nullptr;

    /// Errors (NoDevice): there is no loader, or a function is missing; with its name.
    static Expected<VulkanFunctions> of(VkInstance instance, VkDevice device);
};

}  // namespace gazeloop::openxr_layer
