#pragma once

#include "runtime/openxr/instance.h"
#include "runtime/vulkan/factory.h"

namespace gazeloop::openxr {

/// Has the runtime make Vulkan's objects, with what its compositor needs
/// (XR_KHR_vulkan_enable2). `instance` must outlive this.
class VulkanObjects final : public vulkan::Factory {
  public:
    explicit VulkanObjects(const Instance& instance) : instance_(instance) {}

    VkInstance create_instance(PFN_vkGetInstanceProcAddr get_proc,
                               const VkInstanceCreateInfo& info) override;
    VkPhysicalDevice choose_physical_device(VkInstance instance) override;
    VkDevice create_device(PFN_vkGetInstanceProcAddr get_proc, VkPhysicalDevice physical,
                           const VkDeviceCreateInfo& info) override;

  private:
    const Instance& instance_;
};

}  // namespace gazeloop::openxr
