#pragma once

#include <cstdint>
#include <vulkan/vulkan_raii.hpp>

namespace gazeloop::vulkan {

/// What an image is used for next.
enum class Use : std::uint8_t {
    ColorTarget,  ///< drawn into
    DepthTarget,  ///< drawn into, of its depth
    Sampled,      ///< read by fragment shaders
    Loaded,       ///< read by fragment shaders as a storage image, texel by texel
    CopySource,   ///< copied or scaled from
    CopyTarget,   ///< copied or scaled into
};

/// Whether what an image holds is needed by its next use.
enum class Keep : bool { Nothing, Content };

/// An image that knows how it was used last, and so which barrier its next use needs. One queue, in
/// the order of recording; the image must outlive this.
class TrackedImage {
  public:
    TrackedImage() = default;
    /// Nobody has used it yet.
    TrackedImage(vk::Image image, vk::ImageAspectFlags aspect) : image_(image), aspect_(aspect) {}

    /// An image whose last use is known.
    static TrackedImage in_use(vk::Image image, vk::ImageAspectFlags aspect, Use last);

    /// An image that earlier frames may still draw into or copy, such as a swapchain's.
    static TrackedImage of_earlier_frames(vk::Image image, vk::ImageAspectFlags aspect);

    /// Records the transition to the next use. Nothing is recorded between two reads of a kind.
    void use(const vk::raii::CommandBuffer& commands, Use next, Keep keep = Keep::Content);

    [[nodiscard]] vk::Image image() const { return image_; }
    /// As the last use left it; undefined before the first.
    [[nodiscard]] vk::ImageLayout layout() const { return layout_; }

  private:
    vk::Image image_;
    vk::ImageAspectFlags aspect_ = vk::ImageAspectFlagBits::eColor;
    vk::ImageLayout layout_ = vk::ImageLayout::eUndefined;
    vk::PipelineStageFlags2 stages_ = vk::PipelineStageFlagBits2::eNone;
    vk::AccessFlags2 writes_ = vk::AccessFlagBits2::eNone;
};

}  // namespace gazeloop::vulkan
