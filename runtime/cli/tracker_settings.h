#pragma once

#include "runtime/cli/profiles.h"
#include "runtime/cli/settings.h"
#include "runtime/error.h"

namespace gazeloop::cli {

/// The tracker profile that the settings name. What it states becomes the value of those sim.*
/// settings that are still built in, so that `--gaze sim --tracker NAME` simulates that tracker.
/// Errors: as load_tracker().
Expected<TrackerProfile> tracker_in_force(Settings& settings);

}  // namespace gazeloop::cli
