#pragma once

#include <string>
#include <vector>

#include "drivers/device/tracker_probe.h"
#include "runtime/doctor/checks.h"

namespace gazeloop::doctor {

/// What `gazeloop devices` found, for people: each tracker with what it states, does, and lacks.
[[nodiscard]] std::string devices_text(const std::vector<drivers::TrackerProbe>& probes);

/// The same for programs, as JSON, and after it what was found of OpenXR's eye gaze (as
/// openxr_gaze_json() tells it); what is unknown is null.
[[nodiscard]] std::string devices_json(const std::vector<drivers::TrackerProbe>& probes,
                                       const Findings& openxr);

/// Whether gaze came from any of them.
[[nodiscard]] bool any_gaze(const std::vector<drivers::TrackerProbe>& probes);

}  // namespace gazeloop::doctor
