#pragma once

#include <string>
#include <vector>

#include "drivers/steam_frame/eye_service.h"
#include "runtime/settings/setting_row.h"

namespace gazeloop::drivers::steam_frame {

/// The settings steam_frame.*
struct SteamFrameSettings {
    std::string file = kServiceFile;
    std::string rays = "filtered";
};

[[nodiscard]] std::vector<settings::SettingRow> rows_of(SteamFrameSettings& steam_frame);

/// Precondition: set through those rows.
[[nodiscard]] SteamFrameOptions options_of(const SteamFrameSettings& steam_frame,
                                           const TrackerDelay& delay);

}  // namespace gazeloop::drivers::steam_frame
