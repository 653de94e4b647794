#pragma once

#include <vector>

#include "runtime/settings/setting_row.h"

namespace gazeloop::drivers::hid {

/// The settings hid.*, in metres. For screen and viewing distance 0 means: as the tracker states.
struct HidSettings {
    double screen_width_m = 0.0;
    double screen_height_m = 0.0;
    double viewing_distance_m = 0.0;
    double eye_distance_m = 0.063;
};

[[nodiscard]] std::vector<settings::SettingRow> rows_of(HidSettings& hid);

}  // namespace gazeloop::drivers::hid
