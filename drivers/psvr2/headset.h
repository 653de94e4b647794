#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "drivers/device/found_device.h"
#include "drivers/device/tracker_device.h"
#include "drivers/device/tracker_probe.h"
#include "drivers/psvr2/gaze_samples.h"

namespace gazeloop::drivers::psvr2 {

struct Psvr2Options {
    TrackerDelay delay;
};

inline constexpr TrackerSupport kSupport{
    "psvr2", "PlayStation VR2 over USB: verified with emulated devices, not tried on hardware"};

/// The headsets that are plugged in.
[[nodiscard]] std::vector<FoundDevice> find_headsets();

/// Claims a headset's gaze interface, asks for gaze, and reads it. Uses libusb with several
/// transfers under way, so that no packet is missed while one is handled.
///
/// A halted endpoint is cleared and gaze is asked for again; several failures in a row without data
/// between them end it. Each failure gives a sample without gaze at once, whatever follows. While
/// the headset is silent it is asked again (stream_keeper.h). Each change is reported.
///
/// Errors (NoDevice): it may not be opened, has no gaze interface, or another program has claimed
/// that. The message says which program that may be and what helps.
[[nodiscard]] Expected<std::unique_ptr<TrackerDevice>> open_headset(const FoundDevice& found,
                                                                    const Psvr2Options& options);

/// Opens the first headset that is plugged in; null where there is none.
[[nodiscard]] Expected<std::unique_ptr<TrackerDevice>> open_any_headset(
    const Psvr2Options& options);

/// Listens to each headset that is plugged in.
[[nodiscard]] std::vector<TrackerProbe> probe_headsets(const Psvr2Options& options,
                                                       std::chrono::milliseconds listen,
                                                       const StopRequested& stop);

}  // namespace gazeloop::drivers::psvr2
