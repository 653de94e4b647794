#pragma once

#include <cstdint>
#include <optional>
#include <vulkan/vulkan.hpp>

namespace gazeloop::vulkan {

/// What memory is for, which decides the type that is taken.
enum class MemoryFor : std::uint8_t {
    Upload,    ///< the host writes every frame, the device reads once
    ReadBack,  ///< the device writes, the host reads: cached, where the device has such
    Device,    ///< the device reads for every fragment, or draws into: its own memory
};

/// The first type that the mask allows and that suits best, of a device's properties. On a discrete
/// GPU, host-visible types usually lie in system memory, behind the bus. None: no type will do.
[[nodiscard]] std::optional<std::uint32_t> choose_memory_type(
    const vk::PhysicalDeviceMemoryProperties& properties, std::uint32_t mask, MemoryFor purpose);

}  // namespace gazeloop::vulkan
