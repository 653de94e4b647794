#pragma once

#include <optional>
#include <vector>

#include "runtime/openxr/session.h"
#include "runtime/present/frame_target.h"
#include "runtime/present/openxr/openxr_swapchain.h"

namespace gazeloop::present {

/// How large the runtime wants each eye's picture, times `scale`, no more than it takes. Throws
/// SetupError (NoDevice) for a runtime without two views.
gaze::PerEye<vk::Extent2D> picture_extents(const openxr::Instance& instance, double scale);

/// Both eyes' pictures, and depth images if there are any, and the layer that they make.
class OpenXrPictures {
  public:
    /// With `depth`, depth images where the runtime has a format for them. Throws SetupError.
    OpenXrPictures(const vulkan::Context& context, const openxr::Session& session,
                   const gaze::PerEye<vk::Extent2D>& extents, bool depth);

    [[nodiscard]] vk::Format format() const { return format_; }
    [[nodiscard]] std::optional<vk::Format> depth_format() const { return depth_format_; }

    gaze::PerEye<render::EyeTarget> acquire();
    void release();

    /// What xrEndFrame takes of the pictures released last, as seen from the frame's views. Valid
    /// until the next call.
    [[nodiscard]] const XrCompositionLayerBaseHeader* layer(const TargetFrame& frame,
                                                            XrSpace space);

  private:
    void make_depths(const vulkan::Context& context, const openxr::Session& session,
                     const gaze::PerEye<vk::Extent2D>& extents);

    vk::Format format_ = vk::Format::eUndefined;
    std::optional<vk::Format> depth_format_;
    std::vector<OpenXrSwapchain> colors_;
    std::vector<OpenXrSwapchain> depths_;  ///< none without a depth format
    gaze::PerEye<XrCompositionLayerProjectionView> layer_views_{};
    gaze::PerEye<XrCompositionLayerDepthInfoKHR> layer_depths_{};
    XrCompositionLayerProjection layer_{};
};

}  // namespace gazeloop::present
