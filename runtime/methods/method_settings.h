#pragma once

#include <vector>

#include "runtime/methods/acuity_settings.h"
#include "runtime/methods/kfr_settings.h"
#include "runtime/methods/layers_settings.h"
#include "runtime/methods/rings_settings.h"
#include "runtime/methods/sparse_settings.h"
#include "runtime/settings/setting_row.h"

namespace gazeloop::methods {

/// The settings of all methods.
struct MethodSettings {
    AcuitySettings acuity;
    KfrSettings kfr;
    LayersSettings layers;
    RingsSettings rings;
    SparseSettings sparse;
};

[[nodiscard]] std::vector<settings::SettingRow> rows_of(MethodSettings& methods);

}  // namespace gazeloop::methods
