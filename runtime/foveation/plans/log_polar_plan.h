#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "runtime/foveation/log_polar/lp_size.h"
#include "runtime/foveation/log_polar/map_uniforms.h"
#include "runtime/foveation/log_polar/radial_map.h"
#include "runtime/foveation/plans/method_plan.h"

namespace gazeloop::foveation {

/// Which samples one eye's picture takes by a log-polar method: texels of the LP-buffer, and
/// directly shaded pixels of the disc around the fovea.
struct LogPolarPlan {
    LpSize lp;
    /// Set by plan_kfr only, whose map is centred by a translation; else 0.
    gaze::PixelPosition fovea;
    double log2_max_radius = 0.0;
    double disc_border_px = 0.0;  ///< the blend lies inside the radius
    /// 0: no disc. If set by plan_acuity, it is only the radius of the ring to draw, exact for a
    /// centred gaze.
    double disc_radius_px = 0.0;
    /// Set by plan_acuity only, whose map is centred by a rotation.
    struct InGazeFrame {
        GazeFrameUniforms uniforms;
        double disc_half_sine = 0.0;    ///< sin(e / 2) of the disc's eccentricity; 0: no disc
        double border_half_sine = 0.0;  ///< the blend lies inside
    };
    std::optional<InGazeFrame> in_gaze_frame;
    ShadedGrid texels;  ///< of the LP-buffer that some pixel reads; no tile: the disc covers all
    ShadedGrid disc;    ///< pixels that are shaded directly; none without a disc
};

/// Names of the two grids, in this order: "lp", "picture".
[[nodiscard]] const frame::GridList& log_polar_grids();

/// Of a plan whose map leaves nothing out around the fovea.
inline constexpr double kNoCore = -1.0;

/// The LP part of every plan: fills `texels` with what the bilinear reads of pixel centres touch.
/// Only pixel centres at columns beyond `core_u` count (kNoCore: all). Where an area is hidden,
/// only visible ones count. Precondition: plan.lp is set.
void plan_lp_tiles(const RadialMap& map, double core_u, const HiddenArea* hidden,
                   LogPolarPlan& plan);

/// The disc's part of every plan. `band_of(y0, y1)` gives the columns of the disc's pixels in the
/// rows [y0, y1). Precondition: disc.start().
template <typename BandOf>
void plan_disc_tiles(std::uint32_t height_px, const HiddenArea* hidden, const BandOf& band_of,
                     ShadedGrid& disc) {
    for (std::uint32_t y0 = 0; y0 < height_px; y0 += kBandRows) {
        const std::uint32_t y1 = std::min(y0 + kBandRows, height_px);
        const auto pixels = [&](const Columns& band) {
            return band.empty() ? 0 : std::uint64_t{y1 - y0} * (band.end - band.first);
        };
        Columns& band = disc.bands.emplace_back(band_of(y0, y1));
        const std::uint64_t planned = pixels(band);
        if (hidden != nullptr) {
            band = common(band, hidden->visible_columns(y0));
        }
        const std::uint64_t shaded = pixels(band);
        disc.counts.planned += planned;
        disc.counts.shaded += shaded;
        disc.counts.hidden += planned - shaded;
    }
    append_band_tiles(disc.bands, height_px, disc.tiles);
}

/// What the shaders are told of a plan (shaders/lib/log_polar.glsl).
[[nodiscard]] MapUniforms map_uniforms(const LogPolarPlan& plan);

/// Puts them into a method's plan, and takes them from it.
void put_map_uniforms(const MapUniforms& uniforms, EyePlan& plan);
[[nodiscard]] MapUniforms map_uniforms_of(const EyePlan& plan);

/// Lets `make(LogPolarPlan&)` fill a log-polar plan in the memory of a method's plan, and takes the
/// result over.
template <typename Make>
void plan_log_polar(EyePlan& plan, const Make& make) {
    plan.grids.resize(2);
    LogPolarPlan made;
    made.texels = std::move(plan.grids[0]);
    made.disc = std::move(plan.grids[1]);
    make(made);
    put_map_uniforms(map_uniforms(made), plan);
    plan.ring_px = made.disc_radius_px;
    plan.grids[0] = std::move(made.texels);
    plan.grids[1] = std::move(made.disc);
}

}  // namespace gazeloop::foveation
