#include "runtime/openxr/vulkan_objects.h"

#include <fmt/core.h>

#include <vulkan/vulkan_raii.hpp>

#include "runtime/error.h"
#include "runtime/vulkan/driver_environment.h"

namespace gazeloop::openxr {
namespace {

void check_vulkan(VkResult result, const Instance& instance, std::string_view what) {
    if (result != VK_SUCCESS) {
        throw SetupError(
            ErrorKind::NoDevice,
            fmt::format("{} could not create {} ({}): {}", instance.runtime_name(), what,
                        vk::to_string(vk::Result{result}), vulkan::no_driver_remedy()));
    }
}

/// A call by which the runtime looks at Vulkan.
void check_call(XrResult result, const char* call) {
    if (XR_FAILED(result)) {
        const std::string fault = vulkan::driver_environment_fault();
        xr_check(result, fault.empty() ? call : fmt::format("{}: {}", fault, call));
    }
}

/// The least version that the runtime takes; the greatest is only what it was tried with.
void check_version(XrVersion least, std::uint32_t ours, const Instance& instance) {
    const XrVersion offered =
        XR_MAKE_VERSION(VK_API_VERSION_MAJOR(ours), VK_API_VERSION_MINOR(ours), 0);
    if (least > offered) {
        throw SetupError(
            ErrorKind::NoDevice,
            fmt::format("{} wants Vulkan {}.{} or later, gazeloop uses {}.{}: use another OpenXR "
                        "runtime (XR_RUNTIME_JSON), or --target headless",
                        instance.runtime_name(), XR_VERSION_MAJOR(least), XR_VERSION_MINOR(least),
                        VK_API_VERSION_MAJOR(ours), VK_API_VERSION_MINOR(ours)));
    }
}

}  // namespace

VkInstance VulkanObjects::create_instance(PFN_vkGetInstanceProcAddr get_proc,
                                          const VkInstanceCreateInfo& info) {
    auto requirements =
        typed<XrGraphicsRequirementsVulkan2KHR>(XR_TYPE_GRAPHICS_REQUIREMENTS_VULKAN2_KHR);
    check_call(xr_function<PFN_xrGetVulkanGraphicsRequirements2KHR>(
                   instance_.handle(), "xrGetVulkanGraphicsRequirements2KHR")(
                   instance_.handle(), instance_.system(), &requirements),
               "xrGetVulkanGraphicsRequirements2KHR");
    check_version(requirements.minApiVersionSupported, info.pApplicationInfo->apiVersion,
                  instance_);
    auto create = typed<XrVulkanInstanceCreateInfoKHR>(XR_TYPE_VULKAN_INSTANCE_CREATE_INFO_KHR);
    create.systemId = instance_.system();
    create.pfnGetInstanceProcAddr = get_proc;
    create.vulkanCreateInfo = &info;
    VkInstance instance = VK_NULL_HANDLE;
    VkResult vulkan = VK_SUCCESS;
    check_call(
        xr_function<PFN_xrCreateVulkanInstanceKHR>(instance_.handle(), "xrCreateVulkanInstanceKHR")(
            instance_.handle(), &create, &instance, &vulkan),
        "xrCreateVulkanInstanceKHR");
    check_vulkan(vulkan, instance_, "a Vulkan instance");
    return instance;
}

VkPhysicalDevice VulkanObjects::choose_physical_device(VkInstance instance) {
    auto get = typed<XrVulkanGraphicsDeviceGetInfoKHR>(XR_TYPE_VULKAN_GRAPHICS_DEVICE_GET_INFO_KHR);
    get.systemId = instance_.system();
    get.vulkanInstance = instance;
    VkPhysicalDevice device = VK_NULL_HANDLE;
    check_call(
        xr_function<PFN_xrGetVulkanGraphicsDevice2KHR>(
            instance_.handle(), "xrGetVulkanGraphicsDevice2KHR")(instance_.handle(), &get, &device),
        "xrGetVulkanGraphicsDevice2KHR");
    return device;
}

VkDevice VulkanObjects::create_device(PFN_vkGetInstanceProcAddr get_proc, VkPhysicalDevice physical,
                                      const VkDeviceCreateInfo& info) {
    auto create = typed<XrVulkanDeviceCreateInfoKHR>(XR_TYPE_VULKAN_DEVICE_CREATE_INFO_KHR);
    create.systemId = instance_.system();
    create.pfnGetInstanceProcAddr = get_proc;
    create.vulkanPhysicalDevice = physical;
    create.vulkanCreateInfo = &info;
    VkDevice device = VK_NULL_HANDLE;
    VkResult vulkan = VK_SUCCESS;
    check_call(
        xr_function<PFN_xrCreateVulkanDeviceKHR>(instance_.handle(), "xrCreateVulkanDeviceKHR")(
            instance_.handle(), &create, &device, &vulkan),
        "xrCreateVulkanDeviceKHR");
    check_vulkan(vulkan, instance_, "a Vulkan device");
    return device;
}

}  // namespace gazeloop::openxr
