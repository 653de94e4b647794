#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "drivers/device/found_device.h"
#include "drivers/device/tracker_device.h"
#include "drivers/device/tracker_probe.h"
#include "drivers/steam_frame/gaze_samples.h"

namespace gazeloop::drivers::steam_frame {

/// Where the headset's eye service publishes.
inline constexpr const char* kServiceFile = "/dev/shm/eye-server.mmap";

struct SteamFrameOptions {
    std::string file = kServiceFile;
    TrackerDelay delay;
    Rays rays = Rays::Filtered;
};

inline constexpr TrackerSupport kSupport{
    "steam-frame",
    "Steam Frame through its eye service's file: verified with an emulated service, not tried on "
    "hardware"};

/// The service's file, if it is there.
[[nodiscard]] std::vector<FoundDevice> find_services(const SteamFrameOptions& options);

/// Opens the service's file; null where there is none. Looks for new samples as often as their rate
/// asks for (poll_times.h). A sample that is there already counts as old, for nobody knows how long
/// it has been there.
///
/// Errors (NoDevice): the file cannot be read, is of a version that is not known, or not
/// initialised yet. While it is read, it ends with NoDevice when the service removes, replaces,
/// shortens or renounces its file.
[[nodiscard]] Expected<std::unique_ptr<TrackerDevice>> open_service(
    const SteamFrameOptions& options);

/// Listens to the service, if its file is there.
[[nodiscard]] std::vector<TrackerProbe> probe_services(const SteamFrameOptions& options,
                                                       std::chrono::milliseconds listen,
                                                       const StopRequested& stop);

}  // namespace gazeloop::drivers::steam_frame
