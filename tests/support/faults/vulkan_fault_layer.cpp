// A Vulkan layer that makes a healthy device fail on demand: VK_LAYER_GAZELOOP_faults.
// GAZELOOP_VULKAN_FAULTS says which calls (see fault_plan.h) of vkQueueSubmit2, vkWaitSemaphores,
// vkAllocateMemory, vkCreateImage and vkCreateGraphicsPipelines; the effect is the name of a
// VkResult. Once VK_ERROR_DEVICE_LOST has been given, the device stays lost for everything that
// uses it.
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <cstring>
#include <string_view>

#include "tests/support/faults/fault_plan.h"

namespace gazeloop::tests {
namespace {

/// One process, one instance, one device: what gazeloop has off screen.
struct Layer {
    FaultPlan plan = FaultPlan::from_environment("GAZELOOP_VULKAN_FAULTS");
    PFN_vkGetInstanceProcAddr next_instance_proc = nullptr;
    PFN_vkGetDeviceProcAddr next_device_proc = nullptr;
    VkInstance instance = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    bool lost = false;
};

Layer& layer() {
    static Layer the_layer;
    return the_layer;
}

template <typename Function>
Function next(const char* name) {
    return reinterpret_cast<Function>(layer().next_device_proc(layer().device, name));
}

/// The result to give instead of calling down, VK_SUCCESS if there is none.
VkResult fault_at(const char* function, bool uses_device) {
    Layer& l = layer();
    if (const auto effect = l.plan.call(function)) {
        if (*effect == "VK_ERROR_DEVICE_LOST") {
            // What really runs there must not meet the objects that are destroyed next.
            next<PFN_vkDeviceWaitIdle>("vkDeviceWaitIdle")(l.device);
            l.lost = true;
            return VK_ERROR_DEVICE_LOST;
        }
        if (*effect == "VK_ERROR_OUT_OF_DEVICE_MEMORY") {
            return VK_ERROR_OUT_OF_DEVICE_MEMORY;
        }
        refuse_fault(function, *effect);
    }
    return l.lost && uses_device ? VK_ERROR_DEVICE_LOST : VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL queue_submit(VkQueue queue, std::uint32_t count,
                                            const VkSubmitInfo2* submits, VkFence fence) {
    const VkResult fault = fault_at("vkQueueSubmit2", true);
    return fault != VK_SUCCESS
               ? fault
               : next<PFN_vkQueueSubmit2>("vkQueueSubmit2")(queue, count, submits, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL wait_semaphores(VkDevice device, const VkSemaphoreWaitInfo* info,
                                               std::uint64_t timeout) {
    const VkResult fault = fault_at("vkWaitSemaphores", true);
    return fault != VK_SUCCESS
               ? fault
               : next<PFN_vkWaitSemaphores>("vkWaitSemaphores")(device, info, timeout);
}

VKAPI_ATTR VkResult VKAPI_CALL wait_idle(VkDevice device) {
    return layer().lost ? VK_ERROR_DEVICE_LOST
                        : next<PFN_vkDeviceWaitIdle>("vkDeviceWaitIdle")(device);
}

VKAPI_ATTR VkResult VKAPI_CALL counter_value(VkDevice device, VkSemaphore semaphore,
                                             std::uint64_t* value) {
    return layer().lost ? VK_ERROR_DEVICE_LOST
                        : next<PFN_vkGetSemaphoreCounterValue>("vkGetSemaphoreCounterValue")(
                              device, semaphore, value);
}

VKAPI_ATTR VkResult VKAPI_CALL allocate_memory(VkDevice device, const VkMemoryAllocateInfo* info,
                                               const VkAllocationCallbacks* callbacks,
                                               VkDeviceMemory* memory) {
    const VkResult fault = fault_at("vkAllocateMemory", false);
    return fault != VK_SUCCESS
               ? fault
               : next<PFN_vkAllocateMemory>("vkAllocateMemory")(device, info, callbacks, memory);
}

VKAPI_ATTR VkResult VKAPI_CALL create_image(VkDevice device, const VkImageCreateInfo* info,
                                            const VkAllocationCallbacks* callbacks,
                                            VkImage* image) {
    const VkResult fault = fault_at("vkCreateImage", false);
    return fault != VK_SUCCESS
               ? fault
               : next<PFN_vkCreateImage>("vkCreateImage")(device, info, callbacks, image);
}

VKAPI_ATTR VkResult VKAPI_CALL create_pipelines(VkDevice device, VkPipelineCache cache,
                                                std::uint32_t count,
                                                const VkGraphicsPipelineCreateInfo* infos,
                                                const VkAllocationCallbacks* callbacks,
                                                VkPipeline* pipelines) {
    const VkResult fault = fault_at("vkCreateGraphicsPipelines", false);
    return fault != VK_SUCCESS ? fault
                               : next<PFN_vkCreateGraphicsPipelines>("vkCreateGraphicsPipelines")(
                                     device, cache, count, infos, callbacks, pipelines);
}

/// The loader's link to the layer below, which this layer moves on by one.
template <typename LinkInfo>
LinkInfo* link_of(const void* chain, VkStructureType type) {
    for (const auto* at = static_cast<const VkBaseInStructure*>(chain); at != nullptr;
         at = at->pNext) {
        auto* const info = reinterpret_cast<LinkInfo*>(const_cast<VkBaseInStructure*>(at));
        if (at->sType == type && info->function == VK_LAYER_LINK_INFO) {
            return info;
        }
    }
    return nullptr;
}

VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info,
                                               const VkAllocationCallbacks* callbacks,
                                               VkInstance* instance) {
    auto* const link = link_of<VkLayerInstanceCreateInfo>(
        info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
    const PFN_vkGetInstanceProcAddr next_proc = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create =
        reinterpret_cast<PFN_vkCreateInstance>(next_proc(VK_NULL_HANDLE, "vkCreateInstance"));
    const VkResult result = create(info, callbacks, instance);
    layer().next_instance_proc = next_proc;
    layer().instance = *instance;
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical,
                                             const VkDeviceCreateInfo* info,
                                             const VkAllocationCallbacks* callbacks,
                                             VkDevice* device) {
    auto* const link =
        link_of<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    const PFN_vkGetInstanceProcAddr next_proc = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    layer().next_device_proc = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create =
        reinterpret_cast<PFN_vkCreateDevice>(next_proc(layer().instance, "vkCreateDevice"));
    const VkResult result = create(physical, info, callbacks, device);
    layer().device = *device;
    return result;
}

template <typename Function>
PFN_vkVoidFunction as(Function function) {
    return reinterpret_cast<PFN_vkVoidFunction>(function);
}

PFN_vkVoidFunction device_hook(std::string_view name) {
    if (name == "vkQueueSubmit2") {
        return as(&queue_submit);
    }
    if (name == "vkWaitSemaphores") {
        return as(&wait_semaphores);
    }
    if (name == "vkDeviceWaitIdle") {
        return as(&wait_idle);
    }
    if (name == "vkGetSemaphoreCounterValue") {
        return as(&counter_value);
    }
    if (name == "vkAllocateMemory") {
        return as(&allocate_memory);
    }
    if (name == "vkCreateGraphicsPipelines") {
        return as(&create_pipelines);
    }
    return name == "vkCreateImage" ? as(&create_image) : nullptr;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_device_proc(VkDevice device, const char* name) {
    if (std::string_view(name) == "vkGetDeviceProcAddr") {
        return as(&get_device_proc);
    }
    const PFN_vkVoidFunction hook = device_hook(name);
    return hook != nullptr ? hook : layer().next_device_proc(device, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_instance_proc(VkInstance instance, const char* name) {
    const std::string_view wanted = name;
    if (wanted == "vkCreateInstance") {
        return as(&create_instance);
    }
    if (wanted == "vkCreateDevice") {
        return as(&create_device);
    }
    if (wanted == "vkGetDeviceProcAddr") {
        return as(&get_device_proc);
    }
    const PFN_vkVoidFunction hook = device_hook(wanted);
    return hook != nullptr ? hook : layer().next_instance_proc(instance, name);
}

}  // namespace
}  // namespace gazeloop::tests

extern "C" VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* version) {
    constexpr std::uint32_t kInterface = 2;
    if (version->loaderLayerInterfaceVersion < kInterface) {
        return VK_ERROR_INITIALIZATION_FAILED;
    }
    version->loaderLayerInterfaceVersion = kInterface;
    version->pfnGetInstanceProcAddr = &gazeloop::tests::get_instance_proc;
    version->pfnGetDeviceProcAddr = &gazeloop::tests::get_device_proc;
    version->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
