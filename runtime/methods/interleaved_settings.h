#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/settings/setting_row.h"

namespace gazeloop::methods {

/// The settings interleaved.*; the map is that of kfr.*
struct InterleavedSettings {
    std::string every = "4";
    std::string disc_every = "4";
    std::int64_t visits = 8;
    bool jitter = true;
    bool follow = true;
    bool hold = true;
    bool refill = true;
    std::string sharp = "all";
};

[[nodiscard]] std::vector<settings::SettingRow> rows_of(InterleavedSettings& interleaved);

}  // namespace gazeloop::methods
