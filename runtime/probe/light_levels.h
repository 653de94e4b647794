#pragma once

#include <cstddef>

#include "runtime/probe/light_series.h"

namespace gazeloop::probe {

/// The two levels of a light that is switched, from its own brightness over a video.
struct LightLevels {
    double dark = 0.0;    ///< median of the frames of the lower class
    double bright = 0.0;  ///< median of the frames of the upper class
    double noise = 0.0;   ///< within the lower class: median distance from `dark`, as an SD

    /// Whether the light is seen to be switched at all: its levels lie apart by more than they
    /// scatter.
    [[nodiscard]] bool apart() const;
    /// 0 when dark, 1 when bright. Precondition: apart().
    [[nodiscard]] double share(double brightness) const {
        return (brightness - dark) / (bright - dark);
    }
    /// The light is as bright as a picture can show, so that a part of it looks like all of it.
    [[nodiscard]] bool overexposed() const { return bright >= 0.95; }
};

/// Parts the frames in two classes by Lloyd's two-means from the ends of the distribution, less a
/// frame in 500 at either end. In fixed memory. A series without frames: all levels 0.
[[nodiscard]] LightLevels light_levels(const LightSeries& series, Light light);

}  // namespace gazeloop::probe
