#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <vulkan/vulkan_raii.hpp>

#include "runtime/vulkan/context.h"

namespace gazeloop::vulkan {

/// A buffer with memory of its own that the host maps for as long as it lives. Host-visible and
/// coherent: for content that is small and rewritten every frame, or read back (TransferDst). What
/// the device reads again and again belongs in a DeviceBuffer.
class HostBuffer {
  public:
    HostBuffer() = default;
    HostBuffer(const Context& context, vk::DeviceSize bytes, vk::BufferUsageFlags usage);

    [[nodiscard]] vk::Buffer buffer() const { return *buffer_; }
    [[nodiscard]] vk::DeviceSize size() const { return bytes_; }
    [[nodiscard]] std::span<std::byte> mapped() const {
        return {mapped_, static_cast<std::size_t>(bytes_)};
    }

    /// Copies an object to the start, or a range to an offset. Precondition: it fits.
    template <typename T>
    void write(const T& object) {
        static_assert(std::is_trivially_copyable_v<T>);
        std::memcpy(mapped_, &object, sizeof object);
    }
    template <typename T>
    void write(std::span<const T> objects, std::size_t byte_offset = 0) {
        static_assert(std::is_trivially_copyable_v<T>);
        if (!objects.empty()) {
            std::memcpy(mapped_ + byte_offset, objects.data(), objects.size_bytes());
        }
    }

  private:
    vk::raii::DeviceMemory memory_{nullptr};
    vk::raii::Buffer buffer_{nullptr};
    vk::DeviceSize bytes_ = 0;
    std::byte* mapped_ = nullptr;
};

/// A buffer in the device's own memory, filled once: what every fragment reads.
class DeviceBuffer {
  public:
    /// How the content gets there.
    enum class Way : std::uint8_t {
        Shortest,  ///< written by the host, where that memory is visible to it; else copied
        Copied,    ///< through another buffer, as on a discrete GPU
    };
    DeviceBuffer() = default;
    /// Waits for the device if the content is copied.
    DeviceBuffer(const Context& context, std::span<const std::byte> content,
                 vk::BufferUsageFlags usage, Way way = Way::Shortest);

    [[nodiscard]] vk::Buffer buffer() const { return *buffer_; }

  private:
    vk::raii::DeviceMemory memory_{nullptr};
    vk::raii::Buffer buffer_{nullptr};
};

/// A two-dimensional image with memory of its own.
class DeviceImage {
  public:
    [[nodiscard]] vk::Image image() const { return *image_; }
    [[nodiscard]] vk::ImageView view() const { return *view_; }
    [[nodiscard]] vk::Extent2D extent() const { return extent_; }
    [[nodiscard]] vk::Format format() const { return format_; }

  protected:
    DeviceImage() = default;
    DeviceImage(const Context& context, vk::Extent2D extent, vk::Format format,
                vk::ImageUsageFlags usage);

    vk::raii::DeviceMemory memory_{nullptr};
    vk::raii::Image image_{nullptr};
    vk::raii::ImageView view_{nullptr};
    vk::Extent2D extent_;
    vk::Format format_ = vk::Format::eUndefined;
};

/// With a view of its colours.
class ColorImage : public DeviceImage {
  public:
    ColorImage() = default;
    ColorImage(const Context& context, vk::Extent2D extent, vk::Format format,
               vk::ImageUsageFlags usage);
};

/// With a view of its depth; the format has no stencil. For drawing into and reading back.
class DepthImage : public DeviceImage {
  public:
    DepthImage() = default;
    DepthImage(const Context& context, vk::Extent2D extent, vk::Format format);
};

/// A two-dimensional view of level and layer 0: of colours, or of the depth of a format without
/// stencil.
vk::raii::ImageView make_color_view(const Context& context, vk::Image image, vk::Format format);
vk::raii::ImageView make_depth_view(const Context& context, vk::Image image, vk::Format format);

}  // namespace gazeloop::vulkan
