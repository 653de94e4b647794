#pragma once

#include <optional>

#include "runtime/gaze/view.h"

namespace gazeloop::render {

/// The last frame's views, for what follows motion from frame to frame. There are none in the first
/// frame (index 0), after a change of field of view or size, and after a frame that was left out.
/// What was accumulated by then does not fit any more, and replays stay the same.
class LastViews {
  public:
    /// Begins a frame. Returns whether there are last views; if not, histories must be reset.
    bool begin(std::uint64_t index, const gaze::StereoView& views) {
        const bool follows = now_ && index > 0 && index == index_ + 1 && same_pictures(views);
        before_ = follows ? now_ : std::nullopt;
        now_ = views;
        index_ = index;
        return follows;
    }

    /// Null: there are none.
    [[nodiscard]] const gaze::EyeView* of(gaze::Eye eye) const {
        return before_ ? &(*before_)[gaze::index(eye)] : nullptr;
    }

  private:
    [[nodiscard]] bool same_pictures(const gaze::StereoView& views) const {
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            const gaze::EyeView& was = (*now_)[e];
            if (was.fov != views[e].fov || was.width_px != views[e].width_px ||
                was.height_px != views[e].height_px) {
                return false;
            }
        }
        return true;
    }

    std::optional<gaze::StereoView> now_;
    std::optional<gaze::StereoView> before_;
    std::uint64_t index_ = 0;
};

}  // namespace gazeloop::render
