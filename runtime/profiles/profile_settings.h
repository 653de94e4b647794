#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "runtime/settings/setting_row.h"

namespace gazeloop::profiles {

/// The name of no budget.
inline constexpr std::string_view kNoBudget = "none";

/// The settings profile.*: each a name or a .toml file.
struct ProfileSettings {
    std::string budget{kNoBudget};
    std::string display = "fove0";
    std::string tracker = "generic";
};

[[nodiscard]] std::vector<settings::SettingRow> rows_of(ProfileSettings& profile);

}  // namespace gazeloop::profiles
