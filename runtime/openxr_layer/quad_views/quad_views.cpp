#include "runtime/openxr_layer/quad_views/quad_views.h"

#include <algorithm>
#include <optional>

#include "runtime/openxr_layer/foveated_views.h"

namespace gazeloop::openxr_layer {
namespace {

void put(XrView& view, const XrPosef& pose, const XrFovf& fov) {
    view.pose = pose;
    view.fov = fov;
}

XrFovf to_xr_fov(const gaze::FieldOfView& fov) {
    return {static_cast<float>(fov.left_rad), static_cast<float>(fov.right_rad),
            static_cast<float>(fov.up_rad), static_cast<float>(fov.down_rad)};
}

}  // namespace

void fill_four_views(LayeredInstance& layered, XrSession session, XrTime display,
                     const gaze::PerEye<XrView>& two, XrView* views) {
    std::optional<FoveatedViews> seen;
    std::shared_ptr<QuadSession> quad;
    {
        const std::lock_guard lock(layered.mutex);
        if (LayeredSession* const known = layered.session(session)) {
            quad = known->quad;
            seen = foveated_views(layered, *known, display);
            if (seen && seen->follows_gaze()) {
                layered.note_foveation_read(*known);
            }
        }
    }
    for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
        const XrFovf& fov = two[eye].fov;
        put(views[eye], two[eye].pose, fov);
        XrView& inset = views[eye + gaze::kEyeCount];
        put(inset, two[eye].pose, fov);
        gaze::EyeView full{.pose = {},
                           .fov = {fov.angleLeft, fov.angleRight, fov.angleUp, fov.angleDown},
                           .width_px = 1,
                           .height_px = 1};
        if (quad == nullptr || !gaze::is_valid(full)) {
            continue;
        }
        const QuadSizes& sizes = quad->sizes();
        full.width_px = sizes.full.width_px;
        full.height_px = sizes.full.height_px;
        // Without gaze, where it is looked mostly: straight ahead.
        gaze::PixelPosition fovea = gaze::project({0.0, 0.0, -1.0}, full);
        if (seen) {
            const gaze::EyeView& view = seen->views_in_head[eye];
            const CentredPlace place = centred_place(seen->fovea.eyes[eye].position, view);
            fovea = {0.5 * (1.0 + place.x) * full.width_px, 0.5 * (1.0 - place.y) * full.height_px};
        }
        inset.fov = to_xr_fov(place_inset(full, sizes.inset, fovea).fov);
    }
}

}  // namespace gazeloop::openxr_layer
