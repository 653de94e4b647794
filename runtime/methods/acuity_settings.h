#pragma once

#include "runtime/foveation/log_polar/acuity_profile.h"
#include "runtime/settings/settings.h"

namespace gazeloop::methods {

/// What the settings acuity.* say of the map; AcuityProfile::create checks it against a view.
[[nodiscard]] inline foveation::AcuityParameters acuity_parameters(
    const settings::SettingValues& values) {
    const auto& set = values.acuity;
    return {.mar = {.slope = set.mar},
            .pixels_per_degree = set.pixels_per_degree,
            .lp_width = static_cast<std::uint32_t>(set.lp_width),
            .lp_height = static_cast<std::uint32_t>(set.lp_height),
            .disc = set.disc,
            .border_px = set.border_px};
}

}  // namespace gazeloop::methods
