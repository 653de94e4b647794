#pragma once

#include <vector>

#include "runtime/gaze/view.h"
#include "runtime/render/host_picture.h"
#include "runtime/render/png_file.h"
#include "runtime/vulkan/memory.h"

namespace gazeloop::render {

/// Reads back an image that lies in `layout` (and is left in it); waits for the queue. Formats:
/// R8G8B8A8, B8G8R8A8 (SRGB or UNORM: bytes as they are) and R16G16B16A16_SFLOAT (linear: clamped
/// to [0, 1] and sRGB-encoded).
Picture read_back(const vulkan::Context& context, vk::Image image, vk::Extent2D extent,
                  vk::Format format, vk::ImageLayout layout);

/// The same in linear light: R16G16B16A16_SFLOAT as it is, 8-bit formats decoded from sRGB.
LinearPicture read_back_linear(const vulkan::Context& context, vk::Image image, vk::Extent2D extent,
                               vk::Format format, vk::ImageLayout layout);

/// The values of a D32_SFLOAT image that lies in DEPTH_STENCIL_ATTACHMENT_OPTIMAL, top row first.
std::vector<float> read_back_depth(const vulkan::Context& context, const vulkan::DepthImage& image);

/// |a - b| times `gain` for each channel, clamped. Precondition: equal sizes.
Picture amplified_difference(const Picture& a, const Picture& b, double gain);

/// Radius of the ring that marks a fovea where no disc is shaded.
inline constexpr double kRingWithoutDisc_px = 24.0;

/// Draws a ring and a cross around a position; parts beyond the picture are left out.
void mark_fovea(Picture& picture, const gaze::PixelPosition& fovea, double radius_px);

}  // namespace gazeloop::render
