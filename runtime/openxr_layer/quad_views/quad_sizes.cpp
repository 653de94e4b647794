#include "runtime/openxr_layer/quad_views/quad_sizes.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace gazeloop::openxr_layer {

QuadSizes quad_sizes(const PictureSize& full, const InsetPolicy& policy) {
    constexpr double kHalf_rad = std::numbers::pi / 4.0;
    const gaze::EyeView view{.pose = {},
                             .fov = {-kHalf_rad, kHalf_rad, kHalf_rad, -kHalf_rad},
                             .width_px = full.width_px,
                             .height_px = full.height_px};
    return {.full = full, .outer = outer_size(full, policy), .inset = inset_size(view, policy)};
}

std::optional<PictureSize> recommended_size(const NextFunctions& next, XrInstance instance,
                                            XrSystemId system) {
    std::array<XrViewConfigurationView, gaze::kEyeCount> views{};
    for (XrViewConfigurationView& view : views) {
        view.type = XR_TYPE_VIEW_CONFIGURATION_VIEW;
    }
    std::uint32_t count = 0;
    if (XR_FAILED(next.EnumerateViewConfigurationViews(
            instance, system, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO,
            static_cast<std::uint32_t>(views.size()), &count, views.data())) ||
        count != views.size()) {
        return std::nullopt;
    }
    const PictureSize size{
        std::max(views[0].recommendedImageRectWidth, views[1].recommendedImageRectWidth),
        std::max(views[0].recommendedImageRectHeight, views[1].recommendedImageRectHeight)};
    return size.width_px > 0 && size.height_px > 0 ? std::optional(size) : std::nullopt;
}

}  // namespace gazeloop::openxr_layer
