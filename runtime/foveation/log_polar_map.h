#pragma once

#include <cstdint>

#include "runtime/error.h"
#include "runtime/foveation/power_kernel.h"
#include "runtime/gaze/view.h"

namespace gazeloop::foveation {

/// Size of an LP-buffer: columns run outward from the fovea, rows around it.
struct LpSize {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    friend bool operator==(const LpSize&, const LpSize&) = default;
};

struct ImageSize {
    std::uint32_t width_px = 0;
    std::uint32_t height_px = 0;
};

/// The parameters of kernel foveated rendering.
struct KfrParameters {
    static constexpr double kMinSigma = 0.5;
    static constexpr double kMaxSigma = 32.0;

    double sigma = 1.8;  ///< picture width over LP-buffer width, [kMinSigma, kMaxSigma]
    PowerKernel kernel;
    bool disc = true;        ///< shade pixels directly where a texel a pixel is offered
    double border_px = 6.0;  ///< width of the blend from disc to LP-buffer, [0, 64]
};

/// LP-buffer of W/sigma x H/sigma, rounded. Errors (Usage): a parameter out of range or not a
/// number, a picture under 2 x 2 px, an LP-buffer under 2 x 4 texels or over 16384 a side.
Expected<LpSize> lp_buffer_size(const KfrParameters& parameters, ImageSize image);

/// Kernel log-polar mapping around one fovea, variant B (the form of the paper's Eq. 8, figures and
/// released code; its Eq. 10 exchanges K and its inverse), in double precision:
///     u = K(ln r / L),   r = exp(L K^-1(u)),   L = ln rmax
/// with r in pixels from the fovea and u in [0, 1] over the LP-buffer's width. Radii under 1 px map
/// to u = 0. rmax, the distance to the farthest corner, exceeds 1 px for every picture of at least
/// 2 x 2 px, wherever the fovea is.
class LogPolarMap {
  public:
    LogPolarMap(const PowerKernel& kernel, ImageSize image, const gaze::PixelPosition& fovea);

    [[nodiscard]] double u(double radius_px) const;
    [[nodiscard]] double radius_px(double u) const;
    [[nodiscard]] double max_radius_px() const { return max_radius_px_; }
    [[nodiscard]] double log2_max_radius() const;

    /// LP texels that a pixel at this radius is offered: radial times tangential density.
    [[nodiscard]] double texels_per_pixel(double radius_px, LpSize lp) const;

    /// The radius inside which pixels are better shaded directly: the largest one at which the
    /// LP-buffer still offers a texel a pixel, or where it never does, the radius of the kernel's
    /// hole around the fovea (inside it the density falls towards the fovea), as far as closing it
    /// takes at most a tenth as many pixels as there are texels. 0: no such radius.
    [[nodiscard]] double disc_radius_px(LpSize lp) const;

  private:
    PowerKernel kernel_;
    double max_radius_px_;
    double log_max_radius_;
};

}  // namespace gazeloop::foveation
