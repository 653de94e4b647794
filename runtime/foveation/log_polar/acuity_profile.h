#pragma once

#include <cstdint>

#include "runtime/error.h"
#include "runtime/foveation/eye/mar_line.h"
#include "runtime/foveation/log_polar/lp_size.h"
#include "runtime/gaze/view.h"

namespace gazeloop::foveation {

/// The parameters of acuity-derived foveated rendering.
struct AcuityParameters {
    static constexpr double kMinPixelsPerDegree = 0.01;
    static constexpr double kMaxPixelsPerDegree = 1e5;

    MarLine mar{};
    /// The display's density, which limits what the map offers. 0: the greatest in view, so that no
    /// gaze needs another map.
    double pixels_per_degree = 0.0;
    std::uint32_t lp_width = 0;   ///< the LP-buffer's columns; 0: as the line asks for
    std::uint32_t lp_height = 0;  ///< likewise, rows
    bool disc = true;             ///< shade directly where there is a texel per pixel
    double border_px = 6.0;  ///< width of the blend at the gaze from disc to LP-buffer, [0, 64]
};

/// The radial function that a display and a MAR line ask for, Nyquist sampled: the part of the
/// acuity-derived map that does not depend on the gaze. Let p be the pixels per degree. Up to the
/// eccentricity e_c = (2/p - omega0) / m, the display and not the eye is the limit. The number of
/// columns out to an eccentricity is
///     U(e) = p e                                             up to e_c,
///     U(e) = p e_c + (2/m) ln[(omega0 + m e) / (2/p)]        beyond.
/// Where e_c <= 0, it is the logarithm's term alone, with omega0 in place of 2/p. U is continuously
/// differentiable. (The idea is also published as VaFR, arXiv 2503.23410.)
class AcuityProfile {
  public:
    /// Where the map ends; a gaze within 90 degrees of the view's axis sees less.
    static constexpr double kMaxEccentricityDeg = 179.0;

    /// Errors (Usage), each with the value and the valid range:
    ///  - a parameter out of range or not a number;
    ///  - a picture under 2 x 2 px or with a side over 16384;
    ///  - an invalid field of view.
    static Expected<AcuityProfile> create(const AcuityParameters& parameters,
                                          const gaze::EyeView& view);

    [[nodiscard]] double columns(double eccentricity_deg) const;
    [[nodiscard]] double eccentricity_deg(double columns) const;
    [[nodiscard]] double columns_per_degree(double eccentricity_deg) const;

    /// e_c; 0 where the eye is the limit everywhere.
    [[nodiscard]] double display_limit_deg() const { return display_limit_deg_; }
    [[nodiscard]] double pixels_per_degree() const { return pixels_per_degree_; }
    [[nodiscard]] const MarLine& mar() const { return mar_; }

    /// The LP-buffer's size: as stated, else what holds every eccentricity. That is
    /// U(kMaxEccentricityDeg) columns, and the most rows that any eccentricity asks for: the
    /// maximum of 360 sin e min(p, 2 / omega(e)).
    [[nodiscard]] LpSize lp() const { return lp_; }

    /// The share of the LP-buffer's width within an eccentricity, and its inverse: U and U^-1
    /// stretched to the buffer.
    [[nodiscard]] double u(double eccentricity_deg) const;
    [[nodiscard]] double eccentricity_of_u_deg(double u) const;

  private:
    AcuityProfile(const MarLine& mar, double pixels_per_degree);

    MarLine mar_;
    double pixels_per_degree_;
    double display_limit_deg_;
    double omega_at_limit_deg_;  ///< degrees per cycle: 2/p, or omega0 where the eye is the limit
    double max_columns_;
    LpSize lp_;
};

}  // namespace gazeloop::foveation
