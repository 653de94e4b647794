#pragma once

#include <optional>
#include <string>

#include "runtime/run/program_settings.h"

namespace gazeloop::run {

/// How eye trackers are listened to.
struct DevicesRequest {
    bool watch = false;    ///< show live gaze instead of an account of each
    double seconds = 2.0;  ///< to each
    std::string json;      ///< "-": stdout; empty: not asked for
};

/// Listens to every tracker that is plugged in, and says of each what it states, does and lacks.
/// None: gaze came; NoDevice: from none of them; Interrupted: before each was listened to.
/// @throws SetupError: for profiles that are not there, BadInput for a file that cannot be written
std::optional<ErrorKind> listen_to_devices(const DevicesRequest& wanted,
                                           const ProgramSettings& settings);

}  // namespace gazeloop::run
