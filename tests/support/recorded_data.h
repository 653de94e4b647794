#pragma once

#include <filesystem>
#include <string>

namespace gazeloop::tests {

/// A recording of people, or a real scene, in the folder of them that may lie beside the project:
/// they are no part of it. Tests of them are skipped where they are missing, with
/// no_recorded_data() as the reason.
inline std::filesystem::path recorded_data(const std::filesystem::path& name) {
    return std::filesystem::path(GAZELOOP_SOURCE_DIR) / ".." / "shared" / "data" / name;
}

/// Why a test of it is skipped; empty: it is there.
inline std::string no_recorded_data(const std::filesystem::path& name) {
    return std::filesystem::exists(recorded_data(name)) ? "" : "no recorded data: " + name.string();
}

}  // namespace gazeloop::tests
