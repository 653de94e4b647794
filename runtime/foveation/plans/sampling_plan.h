#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/foveation/log_polar/log_polar_map.h"
#include "runtime/foveation/log_polar/map_uniforms.h"
#include "runtime/foveation/picture/band_tiles.h"
#include "runtime/foveation/picture/hidden_area.h"
#include "runtime/foveation/picture/image_size.h"
#include "runtime/foveation/picture/tile.h"
#include "runtime/gaze/view.h"

namespace gazeloop::foveation {

/// Which samples one eye's picture takes at this gaze, and which it leaves out.
struct SamplingPlan {
    LpSize lp;
    gaze::PixelPosition fovea;
    double log2_max_radius = 0.0;
    double disc_radius_px = 0.0;  ///< 0: no disc
    double disc_border_px = 0.0;  ///< the blend lies inside the radius
    /// Plans in the gaze frame alone (plan_acuity). Of the four members above, the disc's radius is
    /// then that of the ring to draw around it, right where the gaze is in the middle, and the
    /// others are 0.
    struct InGazeFrame {
        GazeFrameUniforms uniforms;
        double disc_half_sine = 0.0;    ///< sin(e / 2) of the disc's eccentricity; 0: no disc
        double border_half_sine = 0.0;  ///< the blend lies inside
    };
    std::optional<InGazeFrame> in_gaze_frame;
    std::vector<Columns> lp_bands;    ///< texels that some pixel reads
    std::vector<Columns> disc_bands;  ///< pixels that are shaded directly; none without a disc
    std::vector<Tile> lp_tiles;       ///< what is drawn for lp_bands; empty: the disc covers all
    std::vector<Tile> disc_tiles;     ///< what is drawn for disc_bands
    std::uint64_t texels_shaded = 0;
    std::uint64_t texels_off_screen = 0;
    std::uint64_t texels_under_disc = 0;
    std::uint64_t texels_hidden = 0;  ///< on screen, but read by hidden pixels alone
    std::uint64_t pixels_direct = 0;
};

/// Plans an eye's picture by KFR. Reuses the plan's memory: no allocation once it has grown.
///
/// A texel is in the plan exactly if the bilinear read of some pixel centre outside the disc's
/// unblended core touches it (up to the granularity of kBandRows rows). With a hidden area, which
/// must be of this picture, only visible pixels count (up to their convex hull); null: all do.
void plan_kfr(const KfrParameters& parameters, LpSize lp, ImageSize image,
              const gaze::PixelPosition& fovea, SamplingPlan& plan,
              const HiddenArea* hidden = nullptr);

/// The LP part of every plan: fills lp_tiles and the texel counts with what the bilinear reads of
/// pixel centres at columns beyond `core_u` touch (a negative one: of all pixel centres), and of
/// visible ones where an area is hidden. Precondition: plan.lp.
void plan_lp_tiles(const RadialMap& map, double core_u, const HiddenArea* hidden,
                   SamplingPlan& plan);

}  // namespace gazeloop::foveation
