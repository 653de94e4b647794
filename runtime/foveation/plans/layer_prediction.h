#pragma once

#include "runtime/error.h"
#include "runtime/foveation/plans/eccentricity_layers.h"

namespace gazeloop::foveation {

/// The display that Guenter et al. predict for (section 5.2, Figures 12 and 13), `fov_deg` wide. At
/// its centre it is as sharp as the fovea (omega* = omega0, Eq. 9); its aspect is .75.
/// Precondition: 0 < fov_deg < 180.
[[nodiscard]] LayerDisplay foveal_display(double fov_deg, const MarLine& line);

struct LayerPrediction {
    double display_pixels = 0.0;
    double layer_pixels = 0.0;

    [[nodiscard]] double speedup() const { return display_pixels / layer_pixels; }
};

/// Pixels with and without eccentricity layers on that display; the paper's estimate of speed.
/// Errors: fov_deg outside [1, 179], else as optimise_layers.
Expected<LayerPrediction> predict_layers(double fov_deg, const MarLine& line,
                                         const LayerOptions& options);

/// How straight cost over field of view is.
struct CostGrowth {
    double slope_per_deg = 0.0;    ///< of the least-squares line, pixels per degree
    double worst_deviation = 0.0;  ///< greatest distance from the line / the range's last cost
    /// d ln cost / d ln fov at the range's end: 1 is linear; without foveation it is over 2.
    double end_exponent = 0.0;
};

/// Growth of the layers' cost from `from_deg` to `to_deg`. Errors: as predict_layers.
Expected<CostGrowth> layer_cost_growth(double from_deg, double to_deg, const MarLine& line,
                                       const LayerOptions& options);

}  // namespace gazeloop::foveation
