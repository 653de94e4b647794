#pragma once

#include <cstdint>
#include <span>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

#include "runtime/vulkan/context.h"

namespace gazeloop::vulkan {

/// An image of several levels, layers or cube faces with memory of its own, for drawing into and
/// for shaders to read.
class LayeredImage {
  public:
    struct Form {
        vk::Extent2D extent;
        vk::Format format = vk::Format::eUndefined;
        vk::ImageUsageFlags usage;
        vk::ImageAspectFlags aspect = vk::ImageAspectFlagBits::eColor;
        std::uint32_t levels = 1;
        std::uint32_t layers = 1;
        /// What view() is of: one layer, all of them as an array, or six of them as a cube.
        vk::ImageViewType view = vk::ImageViewType::e2D;
    };

    LayeredImage() = default;
    /// Throws SetupError (NoDevice) where the device has no memory for it.
    LayeredImage(const Context& context, const Form& form);

    [[nodiscard]] vk::Image image() const { return *image_; }
    [[nodiscard]] vk::Extent2D extent() const { return form_.extent; }
    /// What it takes of the device's memory.
    [[nodiscard]] vk::DeviceSize memory_bytes() const { return memory_bytes_; }
    /// All levels and layers.
    [[nodiscard]] vk::ImageView view() const { return *view_; }
    /// Level 0 of one layer, to draw into.
    [[nodiscard]] vk::ImageView layer(std::uint32_t layer) const { return *layer_views_[layer]; }
    [[nodiscard]] vk::ImageSubresourceRange range() const {
        return {form_.aspect, 0, form_.levels, 0, form_.layers};
    }

  private:
    Form form_;
    vk::DeviceSize memory_bytes_ = 0;
    vk::raii::DeviceMemory memory_{nullptr};
    vk::raii::Image image_{nullptr};
    vk::raii::ImageView view_{nullptr};
    std::vector<vk::raii::ImageView> layer_views_;
};

/// The texels of one level of one layer.
struct LevelTexels {
    std::uint32_t level = 0;
    std::uint32_t layer = 0;
    vk::Extent2D extent;
    std::vector<std::byte> bytes;
};

/// Fills an image's levels and layers, all of them; after that shaders may read it. Waits for the
/// device. Precondition: its usage has TransferDst.
void upload(const Context& context, const LayeredImage& image,
            const std::vector<LevelTexels>& texels);

/// What an image of this form takes of the device's memory.
[[nodiscard]] vk::DeviceSize memory_needed(const Context& context, const LayeredImage::Form& form);

/// What an image may take at most: one allocation, of the device's own memory.
[[nodiscard]] vk::DeviceSize most_memory(const Context& context);

/// Lets shaders read an image of which nothing has been written. Waits for the device.
void make_readable(const Context& context, const LayeredImage& image);

/// One layer to fill, and where its texels begin in a buffer.
struct LayerSource {
    std::uint32_t layer = 0;
    vk::DeviceSize offset = 0;
};

/// Records that some layers of an image of one level that shaders read are filled: frames that were
/// submitted before still see what was there, later ones what is now. Precondition: its usage has
/// TransferDst, the buffer's TransferSrc.
void replace_layers(const vk::raii::CommandBuffer& commands, const LayeredImage& image,
                    vk::Buffer from, std::span<const LayerSource> layers);

}  // namespace gazeloop::vulkan
