#pragma once

#include <optional>

#include "runtime/error.h"
#include "runtime/profiles/profile_settings.h"
#include "runtime/profiles/profiles.h"
#include "runtime/settings/settings.h"

namespace gazeloop::profiles {

/// The profiles that the settings name. `all`, here and below, holds the rows of `named`. Errors:
/// as load_display() and its kin, with the place where the profile was named in front.
Expected<display::DisplayProfile> display_in_force(const ProfileSettings& named,
                                                   const settings::Settings& all);
Expected<TrackerProfile> tracker_in_force(const ProfileSettings& named,
                                          const settings::Settings& all);
/// None where the setting says kNoBudget.
Expected<std::optional<latency::LatencyBudget>> budget_in_force(const ProfileSettings& named,
                                                                const settings::Settings& all);

/// The tracker that is to be simulated. What its profile states becomes the value of those sim.*
/// settings that still have their built-in value, so that `--gaze sim --tracker NAME` simulates
/// that tracker. Errors: as tracker_in_force().
Expected<TrackerProfile> simulate_tracker_in_force(const ProfileSettings& named,
                                                   settings::Settings& all);

}  // namespace gazeloop::profiles
