#pragma once

#include <filesystem>
#include <optional>

#include "runtime/environment.h"

namespace gazeloop::openxr_layer {

/// A folder of the user's by the XDG base directory specification: what `variable` names, if that
/// is absolute, else `below_home` in $HOME. None where there is no home either.
[[nodiscard]] inline std::optional<std::filesystem::path> user_folder(const char* variable,
                                                                      const char* below_home) {
    if (const auto named = environment_value(variable);
        named && std::filesystem::path(*named).is_absolute()) {
        return *named;
    }
    const auto home = environment_value("HOME");
    return home ? std::optional(std::filesystem::path(*home) / below_home) : std::nullopt;
}

[[nodiscard]] inline std::optional<std::filesystem::path> user_config() {
    return user_folder("XDG_CONFIG_HOME", ".config");
}
[[nodiscard]] inline std::optional<std::filesystem::path> user_data() {
    return user_folder("XDG_DATA_HOME", ".local/share");
}
/// Where the layer keeps what it has to say: log and sightings.
[[nodiscard]] inline std::optional<std::filesystem::path> layer_state() {
    auto state = user_folder("XDG_STATE_HOME", ".local/state");
    return state ? std::optional(*state / "gazeloop/layer") : std::nullopt;
}

}  // namespace gazeloop::openxr_layer
