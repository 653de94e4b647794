#pragma once

#include <cstdint>

#include "runtime/error.h"
#include "runtime/foveation/log_polar/radial_kernel.h"
#include "runtime/foveation/log_polar/radial_map.h"
#include "runtime/foveation/picture/image_size.h"

namespace gazeloop::foveation {

/// The parameters of kernel foveated rendering.
struct KfrParameters {
    static constexpr double kMinSigma = 0.5;
    static constexpr double kMaxSigma = 32.0;
    static constexpr double kMaxAspect = 16.0;

    double sigma = 1.8;  ///< picture width over LP-buffer width, [kMinSigma, kMaxSigma]
    RadialKernel kernel{};
    bool disc = true;             ///< shade directly where there is a texel per pixel
    double border_px = 6.0;       ///< width of the blend from disc to LP-buffer, [0, 64]
    std::uint32_t lp_width = 0;   ///< the LP-buffer's; 0: the picture's over sigma
    std::uint32_t lp_height = 0;  ///< likewise
    /// The LP-buffer's width over its height, [0, kMaxAspect], with as many texels as by sigma; 0:
    /// the picture's. A side that is stated stays as it is.
    double aspect = 0.0;
    /// Without the disc: still shade the few pixels around the fovea directly where there is less
    /// than one column per pixel (LogPolarMap::hole_radius_px).
    bool close_hole = false;
};

/// The LP-buffer's size: as stated, else W/sigma x H/sigma (or as aspect says), rounded. Errors
/// (Usage):
///  - a parameter out of range or not a number;
///  - a picture under 2 x 2 px, or an LP-buffer under 2 x 4 texels;
///  - a side of either over 16384.
Expected<LpSize> lp_buffer_size(const KfrParameters& parameters, ImageSize image);

/// Kernel log-polar mapping around one fovea, in double precision:
///     u = K(ln r / L),   r = exp(L K^-1(u)),   L = ln rmax
/// (Meng et al. 2018). r is in pixels from the fovea; rmax is the distance to the farthest corner.
/// PowerKernel is variant B, the form of the paper's Eq. 8, figures and released code. Radii
/// under 1 px map to u = 0, radii beyond rmax to 1. rmax is over 1 px for every picture of at least
/// 2 x 2 px, wherever the fovea is.
class LogPolarMap final : public RadialMap {
  public:
    LogPolarMap(RadialKernel kernel, ImageSize image, const gaze::PixelPosition& fovea);

    [[nodiscard]] LpShare share(const gaze::PixelPosition& position) const override;
    [[nodiscard]] std::optional<gaze::PixelPosition> position(const LpShare& share) const override;
    [[nodiscard]] Density density(const gaze::PixelPosition& position, LpSize lp) const override;
    [[nodiscard]] std::optional<ColumnRange> on_screen(double from_rad,
                                                       double to_rad) const override;
    [[nodiscard]] std::optional<ColumnRange> visible(const HiddenArea& hidden, double from_rad,
                                                     double to_rad) const override;

    [[nodiscard]] double u(double radius_px) const;
    [[nodiscard]] double radius_px(double u) const;
    [[nodiscard]] double max_radius_px() const { return max_radius_px_; }
    [[nodiscard]] const gaze::PixelPosition& fovea() const { return fovea_; }
    [[nodiscard]] double log2_max_radius() const;
    [[nodiscard]] Density density(double radius_px, LpSize lp) const;

    /// LP texels per pixel at this radius: radial times tangential density.
    [[nodiscard]] double texels_per_pixel(double radius_px, LpSize lp) const;

    /// The radius within which direct shading saves the most samples: one at which the LP-buffer
    /// falls below one texel per pixel. If the buffer never reaches one texel per pixel, it is the
    /// radius of the kernel's hole at the fovea, in which density falls towards the fovea. That
    /// radius is limited so that closing the hole costs at most a tenth of the LP-buffer's texels.
    /// 0: no disc.
    [[nodiscard]] double disc_radius_px(LpSize lp) const;

    /// The radius of the hole that the kernel leaves at the fovea: where the radial density first
    /// reaches one column per pixel. If it never does, the radius of its peak, limited as for
    /// disc_radius_px.
    [[nodiscard]] double hole_radius_px(LpSize lp) const;

  private:
    [[nodiscard]] double affordable_radius_px(LpSize lp) const;
    template <typename Condition>
    [[nodiscard]] double change_between(double holds_at, double fails_at,
                                        const Condition& condition) const;
    template <typename Function>
    [[nodiscard]] double peak(const Function& function) const;

    RadialKernel kernel_;
    ImageSize image_;
    gaze::PixelPosition fovea_;
    double max_radius_px_;
    double log_max_radius_;
};

}  // namespace gazeloop::foveation
