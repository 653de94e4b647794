#pragma once

#include <vulkan/vulkan.h>

namespace gazeloop::render {

/// Who creates Vulkan's objects: the program itself (headless), or an OpenXR runtime that must add
/// what its compositor needs.
class VulkanFactory {
  public:
    VulkanFactory() = default;
    VulkanFactory(const VulkanFactory&) = delete;
    VulkanFactory& operator=(const VulkanFactory&) = delete;
    virtual ~VulkanFactory() = default;

    /// Each throws SetupError (NoDevice) with the reason and the remedy.
    virtual VkInstance create_instance(PFN_vkGetInstanceProcAddr get_proc,
                                       const VkInstanceCreateInfo& info) = 0;
    /// VK_NULL_HANDLE: no preference, the context chooses.
    virtual VkPhysicalDevice choose_physical_device(VkInstance instance) = 0;
    virtual VkDevice create_device(PFN_vkGetInstanceProcAddr get_proc, VkPhysicalDevice physical,
                                   const VkDeviceCreateInfo& info) = 0;
};

}  // namespace gazeloop::render
