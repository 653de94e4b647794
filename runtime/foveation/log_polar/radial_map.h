#pragma once

#include <optional>

#include "runtime/foveation/log_polar/lp_size.h"
#include "runtime/gaze/view.h"

namespace gazeloop::foveation {

class HiddenArea;

/// A position in an LP-buffer of any size, as shares of its width (outward from the fovea) and of
/// its height (around the fovea). The latter counts in turns: 0 points along the screen's x, a
/// quarter down.
struct LpShare {
    double u = 0.0;  ///< [0, 1]
    double v = 0.0;  ///< [0, 1)
};

/// A range of LpShare::u.
struct ColumnRange {
    double from_u = 0.0;
    double to_u = 0.0;
};

/// LP texels along and across the direction from the fovea, per unit of the map's frame.
struct Density {
    double radial = 0.0;
    double tangential = 0.0;
};

/// A log-polar map at one gaze, in double precision. It has a frame, in which a monotone function
/// relates columns to the distance from the fovea. LogPolarMap measures pixels from a fovea in the
/// picture, AcuityMap degrees from a gaze in space. What does not depend on the gaze lies in
/// MapTables.
class RadialMap {
  public:
    virtual ~RadialMap() = default;

    /// Where the LP-buffer holds a position of the picture. Finite for every finite position.
    [[nodiscard]] virtual LpShare share(const gaze::PixelPosition& position) const = 0;

    /// The inverse of share(); the position may lie beyond the picture. Nothing for a share with no
    /// position in the picture's plane (behind the eye), which occurs only in a frame of angles.
    [[nodiscard]] virtual std::optional<gaze::PixelPosition> position(
        const LpShare& share) const = 0;

    /// Per pixel (LogPolarMap) or per degree (AcuityMap).
    [[nodiscard]] virtual Density density(const gaze::PixelPosition& position, LpSize lp) const = 0;

    /// The columns that pixel centres lie in, within a wedge of directions around the fovea:
    /// `from_rad` to `to_rad`, each LpShare::v times 2 pi, to > from. Nothing if the wedge misses
    /// the screen. Exact for the rectangle that the pixel centres span.
    [[nodiscard]] virtual std::optional<ColumnRange> on_screen(double from_rad,
                                                               double to_rad) const = 0;

    /// The part of on_screen() that visible pixel centres lie in. Exact for their convex hull.
    [[nodiscard]] virtual std::optional<ColumnRange> visible(const HiddenArea& hidden,
                                                             double from_rad,
                                                             double to_rad) const = 0;
};

}  // namespace gazeloop::foveation
