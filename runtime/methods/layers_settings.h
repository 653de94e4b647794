#pragma once

#include <cstdint>
#include <vector>

#include "runtime/foveation/plans/eccentricity_layers.h"
#include "runtime/settings/setting_row.h"

namespace gazeloop::methods {

/// The settings layers.*
struct LayersSettings {
    std::int64_t n = 3;
    bool s2_fixed = false;
    double outer_weight = 1.0;
    bool half_rate = true;
    bool temporal = true;
};

[[nodiscard]] std::vector<settings::SettingRow> rows_of(LayersSettings& layers);

[[nodiscard]] foveation::LayerOptions parameters(const LayersSettings& layers);

}  // namespace gazeloop::methods
