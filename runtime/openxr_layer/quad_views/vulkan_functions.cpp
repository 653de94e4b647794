#include "runtime/openxr_layer/quad_views/vulkan_functions.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <string>

namespace gazeloop::openxr_layer {

Expected<VulkanFunctions> VulkanFunctions::of(VkInstance instance, VkDevice device) {
    const auto missing = [](std::string_view what) {
        return std::unexpected(
            Error{ErrorKind::NoDevice, fmt::format("Vulkan: {} is missing", what)});
    };
    // Never closed: the application uses it too.
    void* const library = ::dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
    const auto get_instance =
        library != nullptr
            ? reinterpret_cast<PFN_vkGetInstanceProcAddr>(::dlsym(library, "vkGetInstanceProcAddr"))
            : nullptr;
    if (get_instance == nullptr) {
        return missing("libvulkan.so.1");
    }
    const auto get_device =
        reinterpret_cast<PFN_vkGetDeviceProcAddr>(get_instance(instance, "vkGetDeviceProcAddr"));
    if (get_device == nullptr) {
        return missing("vkGetDeviceProcAddr");
    }
    VulkanFunctions functions;
#define GAZELOOP_LAYER_FIND(name)                                                    \
    functions.name = reinterpret_cast<PFN_vk##name>(get_device(device, "vk" #name)); \
    if (functions.name == nullptr) {                                                 \
        return missing("vk" #name);                                                  \
    }
    GAZELOOP_LAYER_VULKAN(GAZELOOP_LAYER_FIND)
#undef GAZELOOP_LAYER_FIND
#define GAZELOOP_LAYER_FIND(name)                                                        \
    functions.name = reinterpret_cast<PFN_vk##name>(get_instance(instance, "vk" #name)); \
    if (functions.name == nullptr) {                                                     \
        return missing("vk" #name);                                                      \
    }
    GAZELOOP_LAYER_FIND(GetPhysicalDeviceMemoryProperties)
    GAZELOOP_LAYER_FIND(GetPhysicalDeviceProperties)
    GAZELOOP_LAYER_FIND(GetPhysicalDeviceQueueFamilyProperties)
#undef GAZELOOP_LAYER_FIND
    return functions;
}

}  // namespace gazeloop::openxr_layer
