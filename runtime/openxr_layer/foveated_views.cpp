#include "runtime/openxr_layer/foveated_views.h"

#include <algorithm>

#include "runtime/openxr_layer/stereo_views.h"
#include "runtime/time/clock.h"

namespace gazeloop::openxr_layer {

bool FoveatedViews::follows_gaze() const {
    return std::ranges::all_of(fovea.eyes, [](const gaze::FoveaPoint& eye) {
        return eye.state == gaze::FoveaState::Tracking || eye.state == gaze::FoveaState::OtherEye ||
               eye.state == gaze::FoveaState::Held;
    });
}

std::optional<FoveatedViews> foveated_views(LayeredInstance& layered, LayeredSession& session,
                                            XrTime display) {
    const std::int64_t now_ns = time::monotonic_ns();
    if (session.feed == nullptr || !session.foveae || session.view_space == XR_NULL_HANDLE ||
        !layered.permits_foveation()) {
        return std::nullopt;
    }
    auto views = stereo_views(layered.next, session.handle, session.view_space, display);
    if (!views) {
        return std::nullopt;
    }
    constexpr std::uint32_t kSide_px = 4096;
    for (gaze::EyeView& view : *views) {
        view.width_px = view.height_px = kSide_px;
        if (!gaze::is_valid(view)) {
            return std::nullopt;
        }
    }
    session.feed->take(now_ns, [&](const GazeHistory& history) { session.foveae->take(history); });
    return FoveatedViews{
        .views_in_head = *views,
        .fovea = session.foveae->latch(now_ns, *views, layered.times.host_ns(display))};
}

}  // namespace gazeloop::openxr_layer
