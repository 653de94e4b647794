#pragma once

#include <string>

#include "runtime/calibration/eye_calibration.h"
#include "runtime/error.h"
#include "runtime/settings/settings.h"

namespace gazeloop::calibration {

/// Reads the file that gaze.calibration names, if it does, and sets gaze.calibration_values and
/// gaze.calibration_device to what it says: so a session holds the calibration itself. Errors: as
/// read_calibration(), with the place where the file was named.
[[nodiscard]] Expected<void> take_calibration(const std::string& file, settings::Settings& all);

/// Of gaze.calibration_values; none where it is empty. Errors: as read_values(), with the place
/// where it was set.
[[nodiscard]] Expected<std::optional<Calibration>> calibration_in_force(
    const std::string& values, const settings::Settings& all);

}  // namespace gazeloop::calibration
