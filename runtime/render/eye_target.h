#pragma once

#include <vulkan/vulkan.hpp>

namespace gazeloop::render {

/// Where an eye's picture goes. The depth image, as large as the picture, is there only where the
/// target takes one.
struct EyeTarget {
    vk::Image image;
    vk::ImageView view;
    vk::Image depth_image{};
    vk::ImageView depth_view{};
};

}  // namespace gazeloop::render
