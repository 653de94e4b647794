#include "runtime/vulkan/context.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "runtime/environment.h"
#include "runtime/error.h"
#include "runtime/vulkan/driver_environment.h"
#include "runtime/vulkan/requirements.h"

namespace gazeloop::vulkan {
namespace {

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                          VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data,
                                          void* user) {
    static_cast<std::atomic<std::uint64_t>*>(user)->fetch_add(1);
    spdlog::error("Vulkan validation: {}", data->pMessage);
    return VK_FALSE;
}

int rank(vk::PhysicalDeviceType type) {
    switch (type) {
        case vk::PhysicalDeviceType::eDiscreteGpu:
            return 4;
        case vk::PhysicalDeviceType::eIntegratedGpu:
            return 3;
        case vk::PhysicalDeviceType::eVirtualGpu:
            return 2;
        case vk::PhysicalDeviceType::eCpu:
            return 1;
        default:
            return 0;
    }
}

SetupError no_device(std::string_view what) {
    return {ErrorKind::NoDevice, fmt::format("{}: {}", what, no_driver_remedy())};
}

/// Creates the objects without any runtime's help.
class DirectFactory final : public Factory {
  public:
    VkInstance create_instance(PFN_vkGetInstanceProcAddr get_proc,
                               const VkInstanceCreateInfo& info) override {
        const auto create =
            reinterpret_cast<PFN_vkCreateInstance>(get_proc(VK_NULL_HANDLE, "vkCreateInstance"));
        VkInstance instance = VK_NULL_HANDLE;
        check(create(&info, nullptr, &instance), "no Vulkan instance could be created");
        return instance;
    }
    VkPhysicalDevice choose_physical_device(VkInstance) override { return VK_NULL_HANDLE; }
    VkDevice create_device(PFN_vkGetInstanceProcAddr, VkPhysicalDevice physical,
                           const VkDeviceCreateInfo& info) override {
        VkDevice device = VK_NULL_HANDLE;
        check(vkCreateDevice(physical, &info, nullptr, &device),
              "the Vulkan device could not be opened");
        return device;
    }

  private:
    static void check(VkResult result, std::string_view what) {
        if (result != VK_SUCCESS) {
            throw no_device(fmt::format("{} ({})", what, vk::to_string(vk::Result{result})));
        }
    }
};

bool has_layer(const vk::raii::Context& context, std::string_view name) {
    return std::ranges::any_of(context.enumerateInstanceLayerProperties(),
                               [&](const auto& layer) { return name == layer.layerName.data(); });
}

}  // namespace

Context::Context(const ContextOptions& options, Factory* factory) {
    DirectFactory direct;
    Factory* const creator = factory != nullptr ? factory : &direct;
    try {
        create_instance(options, creator);
        choose_device(options, creator);
        create_device(creator);
    } catch (const vk::SystemError& error) {
        throw no_device(fmt::format("Vulkan could not be set up ({})", error.what()));
    }
}

void Context::create_instance(const ContextOptions& options, Factory* factory) {
    const vk::ApplicationInfo application("gazeloop", 1, "gazeloop", 1, VK_API_VERSION_1_3);
    std::vector<const char*> layers;
    std::vector<const char*> extensions;
    const std::array enabled{vk::ValidationFeatureEnableEXT::eSynchronizationValidation};
    const vk::ValidationFeaturesEXT validation(enabled, {});
    const vk::DebugUtilsMessengerCreateInfoEXT messages(
        {},
        vk::DebugUtilsMessageSeverityFlagBitsEXT::eWarning |
            vk::DebugUtilsMessageSeverityFlagBitsEXT::eError,
        vk::DebugUtilsMessageTypeFlagBitsEXT::eValidation |
            vk::DebugUtilsMessageTypeFlagBitsEXT::ePerformance,
        on_message, &validation_messages_);
    if (options.validation) {
        if (!has_layer(context_, kValidationLayer)) {
            const auto path = environment_value("VK_LAYER_PATH");
            throw SetupError(
                ErrorKind::NoDevice,
                fmt::format("vulkan.validation is on, but {} has the layer {}: {}",
                            path ? fmt::format("nothing in VK_LAYER_PATH='{}', which stands for "
                                               "all the usual folders,",
                                               *path)
                                 : "no manifest in the usual folders",
                            kValidationLayer,
                            path ? "unset VK_LAYER_PATH, or name the layer's folder in it"
                                 : "install it (Debian: vulkan-validationlayers)"));
        }
        layers.push_back(kValidationLayer);
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
        extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
    }
    vk::InstanceCreateInfo info({}, &application, layers, extensions);
    if (options.validation) {
        info.pNext = &validation;
    }
    const auto get_proc = context_.getDispatcher()->vkGetInstanceProcAddr;
    instance_ = vk::raii::Instance(
        context_, factory->create_instance(get_proc, static_cast<VkInstanceCreateInfo>(info)));
    if (options.validation) {
        messenger_ = vk::raii::DebugUtilsMessengerEXT(instance_, messages);
    }
}

void Context::choose_device(const ContextOptions& options, Factory* factory) {
    if (const VkPhysicalDevice chosen = factory->choose_physical_device(*instance_)) {
        physical_ = vk::raii::PhysicalDevice(instance_, chosen);
        if (const std::string lacks = lacking(physical_); !lacks.empty()) {
            throw no_device(
                fmt::format("the OpenXR runtime asks for the Vulkan device '{}', which lacks: {}",
                            device_name(), lacks));
        }
        return;
    }
    std::string seen;
    std::optional<vk::raii::PhysicalDevice> best;
    for (vk::raii::PhysicalDevice& candidate : vk::raii::PhysicalDevices(instance_)) {
        const vk::PhysicalDeviceProperties properties = candidate.getProperties();
        const std::string_view name = properties.deviceName.data();
        const std::string lacks = lacking(candidate);
        seen += fmt::format("{}'{}'", seen.empty() ? "" : ", ", name);
        if (!lacks.empty()) {
            seen += fmt::format(" (lacks {})", lacks);
        }
        if (!lacks.empty() || name.find(options.device) == std::string_view::npos) {
            continue;
        }
        if (!best || rank(properties.deviceType) > rank(best->getProperties().deviceType)) {
            best.emplace(std::move(candidate));
        }
    }
    if (!best) {
        if (!options.device.empty() && !seen.empty()) {
            throw SetupError(
                ErrorKind::NoDevice,
                fmt::format("{}: vulkan.device = '{}': no usable Vulkan device has that in its "
                            "name; there are: {}",
                            options.device_origin, options.device, seen));
        }
        throw no_device(seen.empty() ? std::string("there is no Vulkan device")
                                     : "no Vulkan device has all that is needed: " + seen);
    }
    physical_ = std::move(*best);
}

void Context::create_device(Factory* factory) {
    memory_ = physical_.getMemoryProperties();
    queue_family_ = queue_family_of(physical_).value();  // no device is chosen without one
    timestamp_period_ns_ = physical_.getProperties().limits.timestampPeriod;
    timestamp_bits_ = physical_.getQueueFamilyProperties()[queue_family_].timestampValidBits;

    std::vector<const char*> extensions;
    calibrated_timestamps_ = std::ranges::any_of(
        physical_.enumerateDeviceExtensionProperties(), [](const auto& extension) {
            return std::string_view(extension.extensionName.data()) ==
                   VK_EXT_CALIBRATED_TIMESTAMPS_EXTENSION_NAME;
        });
    if (calibrated_timestamps_) {
        extensions.push_back(VK_EXT_CALIBRATED_TIMESTAMPS_EXTENSION_NAME);
    }
    const float priority = 1.0F;
    const vk::DeviceQueueCreateInfo queue({}, queue_family_, 1, &priority);
    vk::PhysicalDeviceFeatures features;
    features.textureCompressionBC = physical_.getFeatures().textureCompressionBC;
    bc_textures_ = features.textureCompressionBC == VK_TRUE;
    // The structures of single features: a runtime may chain its own, and the aggregate ones for
    // 1.2 and 1.3 must not meet them.
    vk::StructureChain<vk::DeviceCreateInfo, vk::PhysicalDeviceTimelineSemaphoreFeatures,
                       vk::PhysicalDeviceSynchronization2Features,
                       vk::PhysicalDeviceDynamicRenderingFeatures>
        chain(vk::DeviceCreateInfo({}, queue, {}, extensions, &features),
              vk::PhysicalDeviceTimelineSemaphoreFeatures(VK_TRUE),
              vk::PhysicalDeviceSynchronization2Features(VK_TRUE),
              vk::PhysicalDeviceDynamicRenderingFeatures(VK_TRUE));
    const auto get_proc = context_.getDispatcher()->vkGetInstanceProcAddr;
    device_ = vk::raii::Device(
        physical_,
        factory->create_device(get_proc, *physical_,
                               static_cast<VkDeviceCreateInfo>(chain.get<vk::DeviceCreateInfo>())));
    queue_ = vk::raii::Queue(device_, queue_family_, 0);
}

std::uint32_t Context::memory_type(std::uint32_t mask, MemoryFor purpose) const {
    if (const auto found = choose_memory_type(memory_, mask, purpose)) {
        return *found;
    }
    throw SetupError(
        ErrorKind::NoDevice,
        fmt::format("the Vulkan device {} has no memory of the needed kind", device_name()));
}

bool Context::is_host_visible(std::uint32_t type) const {
    constexpr auto kShared =
        vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent;
    return (memory_.memoryTypes[type].propertyFlags & kShared) == kShared;
}

std::string Context::device_name() const { return physical_.getProperties().deviceName.data(); }

std::string Context::driver() const {
    const auto chain =
        physical_
            .getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
    const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
    return fmt::format("{} {}", driver.driverName.data(), driver.driverInfo.data());
}

}  // namespace gazeloop::vulkan
