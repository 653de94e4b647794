#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "drivers/device/tracker_probe.h"

namespace gazeloop::doctor {

/// What `gazeloop devices` found, for people: each tracker with what it states, does, and lacks.
[[nodiscard]] std::string devices_text(const std::vector<drivers::TrackerProbe>& probes);

/// The same for programs; what is unknown is null.
[[nodiscard]] nlohmann::ordered_json devices_json(const std::vector<drivers::TrackerProbe>& probes);

/// Whether gaze came from any of them.
[[nodiscard]] bool any_gaze(const std::vector<drivers::TrackerProbe>& probes);

}  // namespace gazeloop::doctor
