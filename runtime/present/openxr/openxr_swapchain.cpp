#include "runtime/present/openxr/openxr_swapchain.h"

#include <fmt/core.h>

#include <utility>

#include "runtime/error.h"
#include "runtime/vulkan/memory.h"

namespace gazeloop::present {

using openxr::typed;
using openxr::xr_check;
using openxr::xr_check_session;

OpenXrSwapchain::OpenXrSwapchain(const vulkan::Context& context, XrSession session,
                                 vk::Extent2D extent, vk::Format format, SwapchainContent content)
    : extent_(extent) {
    auto info = typed<XrSwapchainCreateInfo>(XR_TYPE_SWAPCHAIN_CREATE_INFO);
    const bool depth = content == SwapchainContent::Depth;
    info.usageFlags =
        depth ? XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
              : XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_TRANSFER_SRC_BIT;
    info.format = static_cast<std::int64_t>(format);
    info.sampleCount = 1;
    info.width = extent.width;
    info.height = extent.height;
    info.faceCount = 1;
    info.arraySize = 1;
    info.mipCount = 1;
    xr_check(
        xrCreateSwapchain(session, &info, &swapchain_),
        fmt::format("no swapchain of {}x{} px could be made (xrCreateSwapchain); use a smaller "
                    "picture (--set render.scale=0.5)",
                    extent.width, extent.height));
    std::uint32_t count = 0;
    xr_check(xrEnumerateSwapchainImages(swapchain_, 0, &count, nullptr),
             "xrEnumerateSwapchainImages");
    std::vector<XrSwapchainImageVulkan2KHR> images(
        count, typed<XrSwapchainImageVulkan2KHR>(XR_TYPE_SWAPCHAIN_IMAGE_VULKAN2_KHR));
    xr_check(
        xrEnumerateSwapchainImages(swapchain_, count, &count,
                                   reinterpret_cast<XrSwapchainImageBaseHeader*>(images.data())),
        "xrEnumerateSwapchainImages");
    for (const XrSwapchainImageVulkan2KHR& image : images) {
        images_.emplace_back(image.image);
        views_.push_back(depth ? vulkan::make_depth_view(context, image.image, format)
                               : vulkan::make_color_view(context, image.image, format));
    }
}

OpenXrSwapchain::OpenXrSwapchain(OpenXrSwapchain&& other) noexcept
    : swapchain_(std::exchange(other.swapchain_, XR_NULL_HANDLE)),
      extent_(other.extent_),
      images_(std::move(other.images_)),
      views_(std::move(other.views_)) {}

OpenXrSwapchain::~OpenXrSwapchain() {
    views_.clear();
    if (swapchain_ != XR_NULL_HANDLE) {
        xrDestroySwapchain(swapchain_);
    }
}

OpenXrSwapchain::Image OpenXrSwapchain::acquire() {
    std::uint32_t index = 0;
    const auto acquire = typed<XrSwapchainImageAcquireInfo>(XR_TYPE_SWAPCHAIN_IMAGE_ACQUIRE_INFO);
    xr_check_session(xrAcquireSwapchainImage(swapchain_, &acquire, &index),
                     "xrAcquireSwapchainImage");
    auto wait = typed<XrSwapchainImageWaitInfo>(XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO);
    constexpr XrDuration kPatienceNs = 5'000'000'000;
    wait.timeout = kPatienceNs;
    if (xr_check_session(xrWaitSwapchainImage(swapchain_, &wait), "xrWaitSwapchainImage") ==
        XR_TIMEOUT_EXPIRED) {
        throw SetupError(ErrorKind::SessionLost,
                         "OpenXR: the runtime kept a swapchain image for 5 s "
                         "(xrWaitSwapchainImage: XR_TIMEOUT_EXPIRED): it hangs; start it again");
    }
    return {images_[index], *views_[index]};
}

void OpenXrSwapchain::release() {
    const auto release = typed<XrSwapchainImageReleaseInfo>(XR_TYPE_SWAPCHAIN_IMAGE_RELEASE_INFO);
    xr_check_session(xrReleaseSwapchainImage(swapchain_, &release), "xrReleaseSwapchainImage");
}

XrSwapchainSubImage OpenXrSwapchain::sub_image() const {
    return {swapchain_,
            {{0, 0},
             {static_cast<std::int32_t>(extent_.width), static_cast<std::int32_t>(extent_.height)}},
            0};
}

}  // namespace gazeloop::present
