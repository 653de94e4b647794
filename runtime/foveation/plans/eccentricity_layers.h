#pragma once

#include <cstddef>
#include <vector>

#include "runtime/error.h"
#include "runtime/foveation/eye/mar_line.h"

namespace gazeloop::foveation {

/// A flat display seen from in front of its centre (Guenter et al. 2012, section 4.3).
struct LayerDisplay {
    double half_width_tangent = 1.0;  ///< W* / 2V*: tangent of half the field of view; > 0
    double width_px = 0.0;            ///< D*, along that side; >= 2
    double aspect = 1.0;              ///< alpha*: the other side over that one; > 0

    /// The display's sharpness angle omega*, degrees per cycle (two pixels) at its centre. Eq. 7.
    [[nodiscard]] double sharpness_deg() const;
    /// The display's angular radius e*, degrees. Eq. 6.
    [[nodiscard]] double radius_deg() const;
};

/// How many layers, and what they cost.
struct LayerOptions {
    static constexpr int kMaxLayers = 8;

    int layers = 3;  ///< at most this many; 1 to kMaxLayers
    /// Work per pixel of each layer, inner first. For example 1, .5, .5 if the outer layers are
    /// rendered at half rate. Empty: 1 each. Else as many as layers; each > 0 and finite.
    std::vector<double> weights;
    /// The second layer's sampling factor, if it is fixed as in the studied system (s2 = 2). Then
    /// > 1, with layers >= 3. 0: free.
    double second_factor = 0.0;
};

struct EccentricityLayer {
    /// Outer edge. The last layer's is the display's e*. Where aspect > 1, that layer also covers
    /// what lies beyond.
    double radius_deg = 0.0;
    double factor = 1.0;    ///< s: display pixels per sample, each way
    double width_px = 0.0;  ///< D: samples along its side; of the last layer, the longer side
    double pixels = 0.0;    ///< P: samples in all
    double weight = 1.0;    ///< w: work of one of them
};

struct EccentricityLayers {
    std::vector<EccentricityLayer> layers;  ///< inner first; at least one
    double work = 0.0;                      ///< sum of weight times pixels
    double display_pixels = 0.0;            ///< P*

    [[nodiscard]] double pixel_ratio() const { return display_pixels / work; }
};

/// Radii and sampling factors of eccentricity layers that satisfy a MAR line with the least work.
/// Minimises sum w_i P_i over 0 <= e_1 <= ... <= e_{n-1} <= e*, with
///     s_1 = 1, s_{i+1} = max(1, omega(e_i) / omega*), D_i = 2 D*/s_i tan(e_i) V*/W*, P_i = D_i^2.
/// For the last layer, D_n = D*/s_n and P_n = alpha* D_n^2 (Eqs. 2 to 5). The paper's factors fall
/// below 1 where the display is coarser than the eye. Here they do not, because a layer never needs
/// more than the display's own pixels.
///
/// Fewer layers than asked for come back where more would save nothing. That is so for a narrow
/// display, for one that is coarser than the eye everywhere, and for a flat line (then one layer,
/// at s = 1). Where the display is finer than the fovea itself, the innermost layer may vanish, and
/// s_1 is omega0 / omega*.
///
/// The optimum is global: a dynamic programme over the radii, then ever finer grids around its
/// best. The work is within 1e-6 of the least.
///
/// Errors (Usage): a parameter out of range or not a number, named with its range.
Expected<EccentricityLayers> optimise_layers(const LayerDisplay& display, const MarLine& line,
                                             const LayerOptions& options);

}  // namespace gazeloop::foveation
