#pragma once

#include "runtime/error.h"
#include "runtime/settings/profiles.h"
#include "runtime/settings/settings.h"

namespace gazeloop::settings {

/// The profiles that the settings name. Errors: as load_display() and load_tracker(), with the
/// place where the profile was named in front.
Expected<display::DisplayProfile> display_in_force(const Settings& settings);
Expected<TrackerProfile> tracker_in_force(const Settings& settings);

/// The tracker that is to be simulated: what its profile states becomes the value of those sim.*
/// settings that are still built in, so that `--gaze sim --tracker NAME` simulates that tracker.
/// Errors: as tracker_in_force().
Expected<TrackerProfile> simulate_tracker_in_force(Settings& settings);

}  // namespace gazeloop::settings
