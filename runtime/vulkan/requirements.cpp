#include "runtime/vulkan/requirements.h"

#include <fmt/core.h>

#include <algorithm>

namespace gazeloop::vulkan {
namespace {

bool offers(const vk::raii::PhysicalDevice& device, vk::Format format,
            vk::FormatFeatureFlags wanted) {
    return (device.getFormatProperties(format).optimalTilingFeatures & wanted) == wanted;
}

}  // namespace

std::vector<DeviceRequirement> device_requirements(const vk::raii::PhysicalDevice& device) {
    std::vector<DeviceRequirement> all{
        {"Vulkan 1.3", device.getProperties().apiVersion >= VK_API_VERSION_1_3}};
    if (!all.front().met) {
        return all;  // the features below cannot be asked for
    }
    const auto features =
        device
            .getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceTimelineSemaphoreFeatures,
                          vk::PhysicalDeviceVulkan13Features>();
    const auto& v13 = features.get<vk::PhysicalDeviceVulkan13Features>();
    all.push_back({"timelineSemaphore",
                   features.get<vk::PhysicalDeviceTimelineSemaphoreFeatures>().timelineSemaphore !=
                       VK_FALSE});
    all.push_back({"synchronization2", v13.synchronization2 != VK_FALSE});
    all.push_back({"dynamicRendering", v13.dynamicRendering != VK_FALSE});
    all.push_back({"graphics queue with timestamps", queue_family_of(device).has_value()});
    using Feature = vk::FormatFeatureFlagBits;
    all.push_back({"R16G16B16A16_SFLOAT drawn and filtered",
                   offers(device, vk::Format::eR16G16B16A16Sfloat,
                          Feature::eColorAttachment | Feature::eSampledImage |
                              Feature::eSampledImageFilterLinear)});
    all.push_back({"an 8-bit RGBA format drawn and copied",
                   std::ranges::any_of(kPictureFormats, [&](vk::Format format) {
                       return offers(device, format,
                                     Feature::eColorAttachment | Feature::eTransferSrc);
                   })});
    return all;
}

std::string lacking(const vk::raii::PhysicalDevice& device) {
    std::string names;
    for (const DeviceRequirement& requirement : device_requirements(device)) {
        if (!requirement.met) {
            names += fmt::format("{}{}", names.empty() ? "" : ", ", requirement.name);
        }
    }
    return names;
}

std::optional<std::uint32_t> queue_family_of(const vk::raii::PhysicalDevice& device) {
    const auto families = device.getQueueFamilyProperties();
    const auto family = std::ranges::find_if(families, [](const auto& candidate) {
        return bool(candidate.queueFlags & vk::QueueFlagBits::eGraphics) &&
               candidate.timestampValidBits > 0;
    });
    return family == families.end()
               ? std::nullopt
               : std::optional(static_cast<std::uint32_t>(family - families.begin()));
}

}  // namespace gazeloop::vulkan
