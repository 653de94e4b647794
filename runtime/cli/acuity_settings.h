#pragma once

#include "runtime/cli/settings.h"
#include "runtime/foveation/acuity_profile.h"

namespace gazeloop::cli {

/// What the settings acuity.* say of the map; AcuityProfile::create checks it against a view.
[[nodiscard]] inline foveation::AcuityParameters acuity_parameters(const SettingValues& values) {
    const auto& set = values.acuity;
    return {.mar = {.slope = set.mar},
            .pixels_per_degree = set.pixels_per_degree,
            .lp_width = static_cast<std::uint32_t>(set.lp_width),
            .lp_height = static_cast<std::uint32_t>(set.lp_height),
            .disc = set.disc,
            .border_px = set.border_px};
}

}  // namespace gazeloop::cli
