#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/display/display_profile.h"
#include "runtime/error.h"

namespace gazeloop::profiles {

struct TrackerProfile {
    std::string name;
    std::string description;
    std::int64_t delay_ns = 0;              ///< from exposure to the host's read, at the least
    std::int64_t delay_uncertainty_ns = 0;  ///< of it, either way
    /// What the file states of sim::TrackerTerms: term and value. Of the rest nothing is known.
    std::vector<std::pair<std::string, double>> terms;
    std::vector<std::string> assumed;  ///< keys of the figures that nobody has published
};

/// A profile by name (config/displays, built into the program) or by path (ends in .toml). Errors:
/// Usage for an unknown name (the nearest one is given, and all of them), BadInput for a file that
/// cannot be read or parsed, lacks a figure, has one out of range or one that no profile has (file,
/// and line where there is one).
Expected<display::DisplayProfile> load_display(std::string_view name);
Expected<TrackerProfile> load_tracker(std::string_view name);

}  // namespace gazeloop::profiles
