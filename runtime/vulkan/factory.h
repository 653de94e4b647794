#pragma once

#include <vulkan/vulkan.h>

namespace gazeloop::vulkan {

/// Who creates Vulkan's objects: the program itself (headless), or an OpenXR runtime that must add
/// what its compositor needs.
class Factory {
  public:
    Factory() = default;
    Factory(const Factory&) = delete;
    Factory& operator=(const Factory&) = delete;
    virtual ~Factory() = default;

    /// Each throws SetupError (NoDevice) with the reason and the remedy.
    virtual VkInstance create_instance(PFN_vkGetInstanceProcAddr get_proc,
                                       const VkInstanceCreateInfo& info) = 0;
    /// VK_NULL_HANDLE: no preference, the context chooses.
    virtual VkPhysicalDevice choose_physical_device(VkInstance instance) = 0;
    virtual VkDevice create_device(PFN_vkGetInstanceProcAddr get_proc, VkPhysicalDevice physical,
                                   const VkDeviceCreateInfo& info) = 0;
};

}  // namespace gazeloop::vulkan
