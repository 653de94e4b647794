#include "runtime/vulkan/memory_types.h"

#include <initializer_list>

namespace gazeloop::vulkan {
namespace {

using Property = vk::MemoryPropertyFlagBits;

std::optional<std::uint32_t> first_with(const vk::PhysicalDeviceMemoryProperties& properties,
                                        std::uint32_t mask, vk::MemoryPropertyFlags wanted) {
    for (std::uint32_t type = 0; type < properties.memoryTypeCount; ++type) {
        const bool allowed = (mask & (1U << type)) != 0;
        if (allowed && (properties.memoryTypes[type].propertyFlags & wanted) == wanted) {
            return type;
        }
    }
    return std::nullopt;
}

std::optional<std::uint32_t> first_of(
    const vk::PhysicalDeviceMemoryProperties& properties, std::uint32_t mask,
    std::initializer_list<vk::MemoryPropertyFlags> by_preference) {
    for (const vk::MemoryPropertyFlags wanted : by_preference) {
        if (const auto found = first_with(properties, mask, wanted)) {
            return found;
        }
    }
    return std::nullopt;
}

}  // namespace

std::optional<std::uint32_t> choose_memory_type(
    const vk::PhysicalDeviceMemoryProperties& properties, std::uint32_t mask, MemoryFor purpose) {
    const vk::MemoryPropertyFlags shared = Property::eHostVisible | Property::eHostCoherent;
    switch (purpose) {
        case MemoryFor::Upload:
            return first_of(properties, mask, {shared});
        case MemoryFor::ReadBack:
            return first_of(properties, mask, {shared | Property::eHostCached, shared});
        case MemoryFor::Device:
            return first_of(properties, mask, {Property::eDeviceLocal});
    }
    return std::nullopt;
}

}  // namespace gazeloop::vulkan
