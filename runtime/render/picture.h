#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <vector>

#include "runtime/error.h"
#include "runtime/gaze/view.h"
#include "runtime/vulkan/memory.h"

namespace gazeloop::render {

/// A picture on the host: 8 bits per channel, sRGB-encoded RGB, top row first.
struct Picture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::array<std::uint8_t, 3>> pixels;
};

/// A picture on the host in linear light, Rec.709 primaries, top row first. In units of the scene's
/// radiance; what an 8-bit target held is decoded and lies in [0, 1].
struct LinearPicture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<glm::vec3> pixels;
};

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

/// Errors (BadInput): the file cannot be written; it names file and reason.
Expected<void> write_png(const Picture& picture, const std::filesystem::path& file);

}  // namespace gazeloop::render
