#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/display/display_profile.h"
#include "runtime/error.h"
#include "runtime/latency/budget.h"

namespace gazeloop::profiles {

struct TrackerProfile {
    std::string name;
    std::string description;
    std::int64_t delay_ns = 0;              ///< from exposure to the host's read, at the least
    std::int64_t delay_uncertainty_ns = 0;  ///< of it, either way
    /// What the file states of sim::TrackerTerms: term and value. The other terms are unknown.
    std::vector<std::pair<std::string, double>> terms;
    std::vector<std::string> assumed;  ///< keys of the figures that nobody has published
};

/// A profile by name (config/, built into the program) or by path (ends in .toml). Errors:
/// Usage for an unknown name; the message has the nearest one, and all of them. BadInput, with the
/// file and where possible the line, for a file that cannot be read or parsed, or a figure that is
/// missing, out of range or unknown.
Expected<display::DisplayProfile> load_display(std::string_view name);
Expected<TrackerProfile> load_tracker(std::string_view name);
/// Limits lie in [0.001, 1000] ms, a stage's not above the total's. One of them there must be.
Expected<latency::LatencyBudget> load_budget(std::string_view name);

}  // namespace gazeloop::profiles
