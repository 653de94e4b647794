#pragma once

#include <cstdint>
#include <optional>

#include "runtime/gaze/gaze_to_fovea.h"
#include "runtime/openxr_layer/gaze_history.h"

namespace gazeloop::openxr_layer {

/// Where the foveae of an application's pictures are: by the same policy as in a run of gazeloop
/// (gaze.*), with losses held and led back. Gaze and views are taken in the head. Pure. No memory
/// is allocated after construction.
class FollowedFoveae {
  public:
    explicit FollowedFoveae(const gaze::FoveaPolicy& policy) : gaze_(policy) {}

    /// The samples that came since the last call.
    void take(const GazeHistory& history);

    /// Of views in the head's frame, whose pictures are shown at `display_ns` (host time; none: not
    /// known). Precondition: is_valid(view) of both.
    [[nodiscard]] gaze::FrameFovea latch(std::int64_t now_ns, const gaze::StereoView& views_in_head,
                                         std::optional<std::int64_t> display_ns) const;

  private:
    gaze::GazeToFovea gaze_;
    std::uint64_t taken_ = 0;
};

/// A place in a picture with its middle at 0 and its edges at -1 and 1, x to the right, y up.
struct CentredPlace {
    double x = 0.0;
    double y = 0.0;
};

/// Of a fovea, the nearest place in the picture. Precondition: is_valid(view).
[[nodiscard]] CentredPlace centred_place(const gaze::PixelPosition& position,
                                         const gaze::EyeView& view);

}  // namespace gazeloop::openxr_layer
