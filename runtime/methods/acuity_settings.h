#pragma once

#include <cstdint>
#include <vector>

#include "runtime/foveation/log_polar/acuity_profile.h"
#include "runtime/settings/setting_row.h"

namespace gazeloop::methods {

/// The settings acuity.*: of the method, and of the models of the eye that plans are held against.
struct AcuitySettings {
    double mar = 0.022;
    double pixels_per_degree = 0.0;
    std::int64_t lp_width = 0;
    std::int64_t lp_height = 0;
    bool disc = true;
    double border_px = 6.0;
    double luminance_cd_m2 = 100.0;
    bool nasal = false;
};

[[nodiscard]] std::vector<settings::SettingRow> rows_of(AcuitySettings& acuity);

/// The map's parameters by these settings; AcuityProfile::create checks them against a view.
[[nodiscard]] foveation::AcuityParameters parameters(const AcuitySettings& acuity);

}  // namespace gazeloop::methods
