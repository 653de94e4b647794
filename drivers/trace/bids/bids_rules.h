#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace gazeloop::drivers {

/// What BIDS 1.11.1 requires of an eye tracking recording's JSON: of the physio sidecar, and for
/// gaze on a screen of StimulusPresentation in the events' JSON. Each rule that is broken, as
/// "RecordedEye must be \"left\", \"right\" or \"cyclopean\"; it is \"both\""; empty where all are
/// kept. The rules are one table, from which readers take their error texts and writers are tested.
[[nodiscard]] std::vector<std::string> broken_bids_rules(const nlohmann::json& physio,
                                                         const nlohmann::json& events);

}  // namespace gazeloop::drivers
