#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vulkan/vulkan_raii.hpp>

#include "runtime/vulkan/factory.h"
#include "runtime/vulkan/memory_types.h"

namespace gazeloop::vulkan {

/// What `validation` asks for.
inline constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

struct ContextOptions {
    bool validation = false;  ///< Khronos validation layer with synchronization validation
    std::string device;  ///< part of the device's name; empty: the best one (no factory choice)
    std::string device_origin = "setting";  ///< where that was asked for, for messages
};

/// Instance, device and queue. Vulkan 1.3 with dynamic rendering, synchronization2 and timeline
/// semaphores is required, calibrated timestamps are used where the device has them.
class Context {
  public:
    /// With a null factory the program creates everything itself. Throws SetupError (NoDevice).
    Context(const ContextOptions& options, Factory* factory);

    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;
    ~Context() = default;

    [[nodiscard]] const vk::raii::Instance& instance() const { return instance_; }
    [[nodiscard]] const vk::raii::PhysicalDevice& physical() const { return physical_; }
    [[nodiscard]] const vk::raii::Device& device() const { return device_; }
    [[nodiscard]] const vk::raii::Queue& queue() const { return queue_; }
    [[nodiscard]] std::uint32_t queue_family() const { return queue_family_; }
    [[nodiscard]] bool has_calibrated_timestamps() const { return calibrated_timestamps_; }
    /// Whether shaders may read textures in BC1 to BC7.
    [[nodiscard]] bool has_bc_textures() const { return bc_textures_; }
    [[nodiscard]] double timestamp_period_ns() const { return timestamp_period_ns_; }
    /// Valid bits of the queue's timestamps, 36 to 64.
    [[nodiscard]] std::uint32_t timestamp_bits() const { return timestamp_bits_; }

    /// The type of memory that suits best. Throws SetupError if the device has none.
    [[nodiscard]] std::uint32_t memory_type(std::uint32_t mask, MemoryFor purpose) const;
    /// Whether the host can write into it.
    [[nodiscard]] bool is_host_visible(std::uint32_t type) const;

    [[nodiscard]] std::string device_name() const;
    [[nodiscard]] std::string driver() const;

    /// Warnings and errors of the validation layer so far, from any thread.
    [[nodiscard]] std::uint64_t validation_messages() const { return validation_messages_; }

  private:
    void create_instance(const ContextOptions& options, Factory* factory);
    void choose_device(const ContextOptions& options, Factory* factory);
    void create_device(Factory* factory);

    std::atomic<std::uint64_t> validation_messages_{0};
    vk::raii::Context context_;
    vk::raii::Instance instance_{nullptr};
    vk::raii::DebugUtilsMessengerEXT messenger_{nullptr};
    vk::raii::PhysicalDevice physical_{nullptr};
    vk::raii::Device device_{nullptr};
    vk::raii::Queue queue_{nullptr};
    vk::PhysicalDeviceMemoryProperties memory_;
    std::uint32_t queue_family_ = 0;
    bool calibrated_timestamps_ = false;
    bool bc_textures_ = false;
    double timestamp_period_ns_ = 1.0;
    std::uint32_t timestamp_bits_ = 64;
};

}  // namespace gazeloop::vulkan
