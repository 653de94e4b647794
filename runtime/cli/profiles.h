#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/error.h"
#include "runtime/present/display_profile.h"

namespace gazeloop::cli {

struct TrackerProfile {
    std::string name;
    std::string description;
    std::int64_t delay_ns = 0;  ///< from exposure to the host's read
};

/// A profile by name (config/displays, built into the program) or by path (ends in .toml). Errors:
/// Usage for an unknown name (the nearest one is given), BadInput for a file that cannot be read or
/// parsed, lacks a figure or has one out of range (file, and line where there is one).
Expected<present::DisplayProfile> load_display(std::string_view name);
Expected<TrackerProfile> load_tracker(std::string_view name);

}  // namespace gazeloop::cli
