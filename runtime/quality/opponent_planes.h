#pragma once

#include <cstddef>
#include <span>

#include "runtime/quality/plane.h"
#include "runtime/quality/row_work.h"
#include "runtime/render/host_picture.h"

namespace gazeloop::quality {

/// How a display turns linear light into luminance: 0 gives black, 1 gives black + peak.
struct DisplayLight {
    static constexpr double kMinPeak = 0.1;
    static constexpr double kMaxPeak = 1e4;

    double peak_cd_m2 = 100.0;  ///< [kMinPeak, kMaxPeak]
    /// What the panel leaks and the lenses scatter; [0, peak]. Contrasts are over it.
    double black_cd_m2 = 0.1;
};

/// The channels of opponent colour: luminance, L - 2.3112 M and 50.9875 S - (L + M) of the cones of
/// CIE 2006, all in cd/m2 (Ashraf et al. 2024, "castleCSF"; the cones of an LED-lit LCD). What
/// white has of the two of colour by the published figures (under .012 of its luminance) is taken
/// off in proportion to luminance, so that greys have none.
inline constexpr std::size_t kLuminance = 0;
inline constexpr std::size_t kRedGreen = 1;
inline constexpr std::size_t kYellowViolet = 2;
inline constexpr std::size_t kOpponentChannels = 3;

/// Writes `planes`, which are made of the picture's size if they are not. What the picture holds
/// below 0 is cut, since no display shows it; above 1 it is brighter than the peak.
void opponent_planes(const render::LinearPicture& picture, const DisplayLight& light,
                     const RowWork& work, std::span<Plane, kOpponentChannels> planes);

}  // namespace gazeloop::quality
