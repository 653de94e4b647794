#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/calibration/calibration_samples.h"

namespace gazeloop::calibrate {

/// What came of each eye, for programs. `file`: where the calibration was written; empty: nowhere.
[[nodiscard]] nlohmann::ordered_json result_json(const calibration::CalibrationResult& result,
                                                 const std::string& file);

}  // namespace gazeloop::calibrate
