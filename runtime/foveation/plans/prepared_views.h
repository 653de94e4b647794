#pragma once

#include <optional>

#include "runtime/gaze/view.h"

namespace gazeloop::foveation {

/// For which fields of view and sizes something was prepared.
class PreparedViews {
  public:
    void take(const gaze::StereoView& views) { views_ = views; }

    /// Whether these have the same; never before take().
    [[nodiscard]] bool fit(const gaze::StereoView& views) const {
        if (!views_) {
            return false;
        }
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            const gaze::EyeView& was = (*views_)[e];
            if (was.fov != views[e].fov || was.width_px != views[e].width_px ||
                was.height_px != views[e].height_px) {
                return false;
            }
        }
        return true;
    }

  private:
    std::optional<gaze::StereoView> views_;
};

}  // namespace gazeloop::foveation
