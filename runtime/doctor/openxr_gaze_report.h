#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/doctor/checks.h"

namespace gazeloop::doctor {

/// What `gazeloop devices` found of the OpenXR runtime's eye gaze (doctor::check_eye_gaze), for
/// people.
[[nodiscard]] std::string openxr_gaze_text(const doctor::Findings& findings);

/// The same for programs; what is unknown is null.
[[nodiscard]] nlohmann::ordered_json openxr_gaze_json(const doctor::Findings& findings);

/// Whether gaze came.
[[nodiscard]] bool any_gaze(const doctor::Findings& findings);

}  // namespace gazeloop::doctor
