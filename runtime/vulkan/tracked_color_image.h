#pragma once

#include <vulkan/vulkan_raii.hpp>

#include "runtime/vulkan/memory.h"
#include "runtime/vulkan/tracked_image.h"

namespace gazeloop::vulkan {

/// An image of its own that knows how it was used last.
struct TrackedColorImage {
    TrackedColorImage() = default;
    TrackedColorImage(const Context& context, vk::Extent2D extent, vk::Format format,
                      vk::ImageUsageFlags usage)
        : image(context, extent, format, usage),
          tracked(image.image(), vk::ImageAspectFlagBits::eColor) {}

    ColorImage image;
    TrackedImage tracked;
};

}  // namespace gazeloop::vulkan
