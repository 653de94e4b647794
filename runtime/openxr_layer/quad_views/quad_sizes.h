#pragma once

#include "runtime/openxr_layer/next_functions.h"
#include "runtime/openxr_layer/quad_views/inset.h"

namespace gazeloop::openxr_layer {

/// Two outer views and an inset in each: XR_VARJO_quad_views, and since OpenXR 1.1 the same number
/// as XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO_WITH_FOVEATED_INSET.
inline constexpr auto kQuadViews = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_QUAD_VARJO;
inline constexpr std::uint32_t kQuadViewCount = 4;

/// How large an application's pictures are recommended to be, for both eyes.
struct QuadSizes {
    PictureSize full;  ///< what the runtime gets, as it recommends
    PictureSize outer;
    PictureSize inset;
};

/// For a display whose stereo pictures are recommended to have this size. Before there is a session
/// no runtime tells its fields of view: they are taken for a right angle each way. That an inset
/// covers the same pixels in a wider field makes it wider, as the coarser pixels there ask for.
[[nodiscard]] QuadSizes quad_sizes(const PictureSize& full, const InsetPolicy& policy);

/// What a runtime recommends for stereo; none where it does not tell.
[[nodiscard]] std::optional<PictureSize> recommended_size(const NextFunctions& next,
                                                          XrInstance instance, XrSystemId system);

}  // namespace gazeloop::openxr_layer
