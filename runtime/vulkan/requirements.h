#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

namespace gazeloop::vulkan {

/// Formats that pictures may have, the best first; the ones that encode sRGB by themselves lead.
inline constexpr std::array kPictureFormats{vk::Format::eR8G8B8A8Srgb, vk::Format::eB8G8R8A8Srgb,
                                            vk::Format::eR8G8B8A8Unorm, vk::Format::eB8G8R8A8Unorm};

/// Something the program cannot do without, and whether a device has it.
struct DeviceRequirement {
    std::string name;
    bool met = false;
};

/// All of them, in this order: Vulkan's version, features, queue, formats. If the version is too
/// old, only the version.
[[nodiscard]] std::vector<DeviceRequirement> device_requirements(
    const vk::raii::PhysicalDevice& device);

/// What a device lacks, "a, b"; empty: nothing, it can be used.
[[nodiscard]] std::string lacking(const vk::raii::PhysicalDevice& device);

/// The queue family that everything is submitted to: graphics, with timestamps.
[[nodiscard]] std::optional<std::uint32_t> queue_family_of(const vk::raii::PhysicalDevice& device);

}  // namespace gazeloop::vulkan
