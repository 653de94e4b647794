#pragma once

#include "runtime/foveation/log_polar/acuity_profile.h"
#include "runtime/foveation/log_polar/radial_map.h"
#include "runtime/foveation/picture/gaze_frame.h"

namespace gazeloop::foveation {

/// The acuity-derived log-polar map at one gaze: AcuityProfile in the gaze's frame.
class AcuityMap final : public RadialMap {
  public:
    AcuityMap(const AcuityProfile& profile, const GazeFrame& frame)
        : profile_(profile), frame_(frame) {}

    [[nodiscard]] LpShare share(const gaze::PixelPosition& position) const override;
    [[nodiscard]] std::optional<gaze::PixelPosition> position(const LpShare& share) const override;
    [[nodiscard]] Density density(const gaze::PixelPosition& position, LpSize lp) const override;
    [[nodiscard]] std::optional<ColumnRange> on_screen(double from_rad,
                                                       double to_rad) const override;
    [[nodiscard]] std::optional<ColumnRange> visible(const HiddenArea& hidden, double from_rad,
                                                     double to_rad) const override;

    [[nodiscard]] const GazeFrame& frame() const { return frame_; }
    [[nodiscard]] const AcuityProfile& profile() const { return profile_; }

    /// Texels per degree at an eccentricity in (0, 180).
    [[nodiscard]] Density density_at(double eccentricity_deg, LpSize lp) const;

    /// The eccentricity inside which pixels are better shaded directly: the greatest, up to 90
    /// degrees, at which the LP-buffer offers one texel per pixel. The pixel counts as large as it
    /// is at the gaze, or at the point of the picture nearest to the gaze.
    [[nodiscard]] double disc_eccentricity_deg(LpSize lp) const;

  private:
    [[nodiscard]] std::optional<ColumnRange> columns(
        const std::optional<GazeFrame::RhoRange>& rho) const;

    AcuityProfile profile_;
    GazeFrame frame_;
};

}  // namespace gazeloop::foveation
