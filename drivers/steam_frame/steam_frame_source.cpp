#include "drivers/steam_frame/steam_frame_source.h"

namespace gazeloop::drivers::steam_frame {

SteamFrameSource::SteamFrameSource(const SteamFrameOptions& options)
    : DeviceSource({.subsystem = "",
                    .thread_name = "gaze-frame",
                    .absence = "no " + options.file +
                               ": the Steam Frame's eye service does not run here: "
                               "waiting for it",
                    .open = [options](const StopRequested&) { return open_service(options); }}) {}

std::string SteamFrameSource::description() const {
    return "Steam Frame through its eye service's file (not tried on hardware)";
}

}  // namespace gazeloop::drivers::steam_frame
