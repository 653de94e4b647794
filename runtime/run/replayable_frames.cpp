#include "runtime/run/replayable_frames.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace gazeloop::run {

void ReplayableFrames::on_frame(const frame::FrameRecord& frame) {
    if (frame.index != frames_) {
        throw damaged("missing");
    }
    // Of a frame that shows nothing views may say nothing: an application need not ask for them.
    if (frame.should_render) {
        if (!drawn_) {
            first_views_ = frame.views;
            drawn_ = true;
        }
        for (const gaze::Eye eye : gaze::kEyes) {
            check_view(frame, eye);
        }
    }
    ++frames_;
    samples_consumed_ = samples_told_;
}

std::uint64_t ReplayableFrames::frames() const {
    if (!drawn_) {
        throw SetupError(ErrorKind::BadInput,
                         fmt::format("{}: the session holds no frame to replay{}", file_,
                                     frames_ > 0 ? ": none was to be drawn" : ""));
    }
    return frames_;
}

SetupError ReplayableFrames::damaged(std::string_view what) const {
    return {ErrorKind::BadInput, fmt::format("{}: frame {}: {}: the recording is damaged; "
                                             "replay its gaze with --clock wall instead",
                                             file_, frames_, what)};
}

void ReplayableFrames::check_view(const frame::FrameRecord& frame, gaze::Eye eye) const {
    const gaze::EyeView& view = frame.views[gaze::index(eye)];
    const gaze::EyeView& first = first_views_[gaze::index(eye)];
    const double turn = glm::length(view.pose.orientation) + glm::length(frame.head.orientation);
    const glm::dvec3 place = view.pose.position_m + frame.head.position_m;
    const auto [smallest, largest] = std::minmax(view.width_px, view.height_px);
    if (!gaze::is_valid(view) || smallest < 2 || largest > 16384 ||
        !(std::abs(turn - 2.0) < 1e-3) || !std::isfinite(place.x + place.y + place.z) ||
        !std::isfinite(frame.scene_time_s)) {
        throw damaged(
            fmt::format("impossible view of the {} eye", gaze::kEyeNames[gaze::index(eye)]));
    }
    if (view.width_px != first.width_px || view.height_px != first.height_px) {
        throw damaged("the picture changes its size");
    }
}

}  // namespace gazeloop::run
