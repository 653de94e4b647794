#include "runtime/openxr_layer/followed_foveae.h"

#include <algorithm>

namespace gazeloop::openxr_layer {

using time::Stamp;
using time::StampKind;

void FollowedFoveae::take(const GazeHistory& history) {
    for (std::uint64_t number = std::max(taken_, history.first()); number < history.count();
         ++number) {
        gaze::GazeSample sample = history[number].sample;
        sample.head.reset();  // of the source's own world, which is none of the application's
        gaze_.add(sample);
    }
    taken_ = history.count();
}

gaze::FrameFovea FollowedFoveae::latch(std::int64_t now_ns, const gaze::StereoView& views_in_head,
                                       std::optional<std::int64_t> display_ns) const {
    return gaze_.latch({now_ns, StampKind::Measured}, {}, views_in_head,
                       display_ns ? Stamp{*display_ns, StampKind::Predicted} : Stamp{});
}

CentredPlace centred_place(const gaze::PixelPosition& position, const gaze::EyeView& view) {
    return {std::clamp(2.0 * position.x_px / view.width_px - 1.0, -1.0, 1.0),
            std::clamp(1.0 - 2.0 * position.y_px / view.height_px, -1.0, 1.0)};
}

}  // namespace gazeloop::openxr_layer
