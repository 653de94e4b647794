#pragma once

#include <cstdint>
#include <string>

#include "drivers/steam_frame/eye_service.h"
#include "runtime/simulate/played_gaze.h"

namespace gazeloop::simulate {

/// The eye service that is stood in for.
struct SimulatedSteamFrame {
    std::string file = drivers::steam_frame::kServiceFile;
    std::uint64_t version = 5;  ///< of the file's layout, at most 32 bits
    double delay_ms = 17.0;     ///< from the eye to the file
};

/// Publishes the gaze again and again, each sample so long after it was taken, and gives how many
/// samples that were. @throws SetupError (BadInput): a trace that is refused; the file is there
/// already, or cannot be made
std::uint64_t publish_as_steam_frame(const PlayedGaze& gaze, const SimulatedSteamFrame& service,
                                     const Interrupted& interrupted);

}  // namespace gazeloop::simulate
