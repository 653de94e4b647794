#pragma once

#include <cstdint>
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
    /// All levels and layers.
    [[nodiscard]] vk::ImageView view() const { return *view_; }
    /// Level 0 of one layer, to draw into.
    [[nodiscard]] vk::ImageView layer(std::uint32_t layer) const { return *layer_views_[layer]; }
    [[nodiscard]] vk::ImageSubresourceRange range() const {
        return {form_.aspect, 0, form_.levels, 0, form_.layers};
    }

  private:
    Form form_;
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

}  // namespace gazeloop::vulkan
