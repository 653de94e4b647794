#pragma once

#include <vector>

#include "runtime/foveation/plans/layer_plan.h"
#include "runtime/settings/setting_row.h"

namespace gazeloop::methods {

/// The settings quad.*; built in are those of the public OpenXR layer Quad-Views-Foveated.
struct QuadSettings {
    double section = 0.35;
    double periphery = 0.5;
    double blend = 0.2;
};

[[nodiscard]] std::vector<settings::SettingRow> rows_of(QuadSettings& quad);

/// Its two layers.
[[nodiscard]] std::vector<foveation::LayerShape> layers(const QuadSettings& quad);

}  // namespace gazeloop::methods
