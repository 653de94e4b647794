#pragma once

#include <array>
#include <optional>
#include <vulkan/vulkan_raii.hpp>

#include "runtime/vulkan/tracked_color_image.h"

namespace gazeloop::vulkan {

/// This frame's and the last frame's image of the same name, for what is accumulated over frames.
/// The first frame after a reset has no last one. Use 32-bit floats: half images truncate on
/// lavapipe, and the error adds up.
class History {
  public:
    using Entry = TrackedColorImage;

    History() = default;
    /// `read`: how shaders read it.
    History(const Context& context, vk::Extent2D extent, vk::Format format,
            vk::ImageUsageFlags read = vk::ImageUsageFlagBits::eSampled);

    /// Begins a frame: now() becomes before(), and the older image is reused.
    void advance();
    /// Forgets the past: before() is null until a whole frame has passed.
    void reset() { frames_ = 0; }

    /// Precondition: advance() was called since the reset.
    [[nodiscard]] Entry& now() { return images_[newest_]; }
    /// The image that now() is not, whatever it holds: for a descriptor that nothing is read by.
    [[nodiscard]] Entry& other() { return images_[1 - newest_]; }
    [[nodiscard]] Entry* before() { return frames_ > 1 ? &images_[1 - newest_] : nullptr; }

  private:
    std::array<Entry, 2> images_;
    std::size_t newest_ = 0;
    std::uint64_t frames_ = 0;  ///< since the reset
};

}  // namespace gazeloop::vulkan
