#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace gazeloop::calibrate {

/// Who is logged in; the user's number where that has no name.
[[nodiscard]] std::string login_name();

/// USER.SOURCE.toml in the user's data folder, which is made for its owner alone. `source`: as
/// --gaze has it; what follows a ':' is left out. @throws SetupError: Usage where nothing says
/// where the folder is, BadInput where it cannot be made
[[nodiscard]] std::filesystem::path personal_file(const std::string& user, std::string_view source);

}  // namespace gazeloop::calibrate
