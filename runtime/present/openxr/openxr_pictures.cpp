#include "runtime/present/openxr/openxr_pictures.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>

#include "runtime/error.h"
#include "runtime/openxr/enumerate.h"
#include "runtime/present/scaled_extent.h"

namespace gazeloop::present {
namespace {

using openxr::enumerate;
using openxr::typed;

/// Formats that encode sRGB by themselves first; among them the runtime's preference.
vk::Format choose_color(const std::vector<std::int64_t>& offered,
                        const openxr::Instance& instance) {
    for (const auto& wanted :
         {std::array{vk::Format::eR8G8B8A8Srgb, vk::Format::eB8G8R8A8Srgb},
          std::array{vk::Format::eR8G8B8A8Unorm, vk::Format::eB8G8R8A8Unorm}}) {
        for (const std::int64_t format : offered) {
            if (std::ranges::find(wanted, static_cast<vk::Format>(format)) != wanted.end()) {
                return static_cast<vk::Format>(format);
            }
        }
    }
    throw SetupError(ErrorKind::NoDevice,
                     fmt::format("{} offers no 8-bit RGBA swapchain format; use another runtime "
                                 "or --target headless",
                                 instance.runtime_name()));
}

/// The most exact one that has no stencil.
std::optional<vk::Format> choose_depth(const std::vector<std::int64_t>& offered) {
    for (const vk::Format wanted : {vk::Format::eD32Sfloat, vk::Format::eD16Unorm}) {
        if (std::ranges::find(offered, static_cast<std::int64_t>(wanted)) != offered.end()) {
            return wanted;
        }
    }
    return std::nullopt;
}

}  // namespace

gaze::PerEye<vk::Extent2D> picture_extents(const openxr::Instance& instance, double scale) {
    const auto sizes =
        enumerate(typed<XrViewConfigurationView>(XR_TYPE_VIEW_CONFIGURATION_VIEW),
                  "xrEnumerateViewConfigurationViews", [&](auto... a) {
                      return xrEnumerateViewConfigurationViews(instance.handle(), instance.system(),
                                                               openxr::kStereo, a...);
                  });
    if (sizes.size() != gaze::kEyeCount) {
        throw SetupError(ErrorKind::NoDevice,
                         fmt::format("{} offers {} views for stereo, 2 are needed",
                                     instance.runtime_name(), sizes.size()));
    }
    gaze::PerEye<vk::Extent2D> extents;
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        extents[e] =
            scaled_extent({sizes[e].recommendedImageRectWidth, sizes[e].recommendedImageRectHeight},
                          scale, {sizes[e].maxImageRectWidth, sizes[e].maxImageRectHeight});
    }
    return extents;
}

OpenXrPictures::OpenXrPictures(const vulkan::Context& context, const openxr::Session& session,
                               const gaze::PerEye<vk::Extent2D>& extents, bool depth) {
    const auto offered = enumerate(std::int64_t{0}, "xrEnumerateSwapchainFormats", [&](auto... a) {
        return xrEnumerateSwapchainFormats(session.handle(), a...);
    });
    format_ = choose_color(offered, session.instance());
    for (const vk::Extent2D& extent : extents) {
        colors_.emplace_back(context, session.handle(), extent, format_, SwapchainContent::Color);
    }
    if (depth) {
        depth_format_ = choose_depth(offered);
    }
    if (depth_format_) {
        make_depths(context, session, extents);
    }
}

void OpenXrPictures::make_depths(const vulkan::Context& context, const openxr::Session& session,
                                 const gaze::PerEye<vk::Extent2D>& extents) {
    try {
        for (const vk::Extent2D& extent : extents) {
            depths_.emplace_back(context, session.handle(), extent, *depth_format_,
                                 SwapchainContent::Depth);
        }
    } catch (const SetupError& error) {
        if (error.kind() == ErrorKind::SessionLost) {
            throw;
        }
        // Pictures without depth are worth more than none.
        spdlog::warn("{}; the runtime gets no depth (render.depth=false asks for none)",
                     error.what());
        depths_.clear();
        depth_format_.reset();
    }
}

gaze::PerEye<render::EyeTarget> OpenXrPictures::acquire() {
    gaze::PerEye<render::EyeTarget> targets;
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        const OpenXrSwapchain::Image color = colors_[e].acquire();
        targets[e] = {color.image, color.view};
        if (depth_format_) {
            const OpenXrSwapchain::Image depth = depths_[e].acquire();
            targets[e].depth_image = depth.image;
            targets[e].depth_view = depth.view;
        }
    }
    return targets;
}

void OpenXrPictures::release() {
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        colors_[e].release();
        if (depth_format_) {
            depths_[e].release();
        }
    }
}

const XrCompositionLayerBaseHeader* OpenXrPictures::layer(const TargetFrame& frame, XrSpace space) {
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        const gaze::EyeView& view = frame.views[e];
        XrCompositionLayerProjectionView& layer_view = layer_views_[e];
        layer_view =
            typed<XrCompositionLayerProjectionView>(XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW);
        layer_view.pose = openxr::to_xr(view.pose);
        layer_view.fov = {
            static_cast<float>(view.fov.left_rad), static_cast<float>(view.fov.right_rad),
            static_cast<float>(view.fov.up_rad), static_cast<float>(view.fov.down_rad)};
        layer_view.subImage = colors_[e].sub_image();
        if (depth_format_ && frame.depth) {
            XrCompositionLayerDepthInfoKHR& depth = layer_depths_[e];
            depth = typed<XrCompositionLayerDepthInfoKHR>(XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR);
            depth.subImage = depths_[e].sub_image();
            depth.maxDepth = 1.0F;
            depth.nearZ = frame.depth->near_m;
            depth.farZ = frame.depth->far_m;
            layer_view.next = &depth;
        }
    }
    layer_ = typed<XrCompositionLayerProjection>(XR_TYPE_COMPOSITION_LAYER_PROJECTION);
    layer_.space = space;
    layer_.viewCount = static_cast<std::uint32_t>(layer_views_.size());
    layer_.views = layer_views_.data();
    return reinterpret_cast<const XrCompositionLayerBaseHeader*>(&layer_);
}

}  // namespace gazeloop::present
