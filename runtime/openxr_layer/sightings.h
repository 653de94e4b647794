#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gazeloop::openxr_layer {

/// What an application saw of the layer when it last ran.
struct Sighting {
    std::string application;  ///< as it calls itself
    std::string executable;
    int pid = 0;
    std::string seen_utc;       ///< when it made its instance, 2025-01-31T12:34:56Z
    std::string runtime;        ///< name and version
    std::string eye_gaze;       ///< "layer", "runtime", "not asked for", or why there is none
    std::string source;         ///< whose gaze it is offered; empty: none
    std::string permission;     ///< "allowed", "denied", "asks"; empty: it asked for no gaze
    std::string read_gaze_utc;  ///< when it first read gaze; empty: never
    std::string recording;      ///< of its last session; empty: none
};

/// Keeps it, one file for each executable, mode 0600. Whether that succeeded.
bool keep(const Sighting& sighting);

/// All that are kept, the latest first. What is damaged is left out.
[[nodiscard]] std::vector<Sighting> sightings();

/// 2025-01-31T12:34:56Z
[[nodiscard]] std::string utc_now();

}  // namespace gazeloop::openxr_layer
