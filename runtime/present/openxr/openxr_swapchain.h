#pragma once

#include <cstdint>
#include <vector>

#include "runtime/openxr/xr_check.h"
#include "runtime/render/eye_target.h"
#include "runtime/vulkan/context.h"

namespace gazeloop::present {

/// What a swapchain's images hold.
enum class SwapchainContent { Color, Depth };

/// One eye's swapchain with views of its images.
class OpenXrSwapchain {
  public:
    OpenXrSwapchain(const vulkan::Context& context, XrSession session, vk::Extent2D extent,
                    vk::Format format, SwapchainContent content);
    OpenXrSwapchain(OpenXrSwapchain&& other) noexcept;
    OpenXrSwapchain& operator=(OpenXrSwapchain&&) = delete;
    OpenXrSwapchain(const OpenXrSwapchain&) = delete;
    OpenXrSwapchain& operator=(const OpenXrSwapchain&) = delete;
    ~OpenXrSwapchain();

    /// Acquires the next image and waits until the compositor has let go of it.
    struct Image {
        vk::Image image;
        vk::ImageView view;
    };
    Image acquire();
    void release();

    [[nodiscard]] XrSwapchainSubImage sub_image() const;

  private:
    XrSwapchain swapchain_ = XR_NULL_HANDLE;
    vk::Extent2D extent_;
    std::vector<vk::Image> images_;
    std::vector<vk::raii::ImageView> views_;
};

}  // namespace gazeloop::present
