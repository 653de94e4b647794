#pragma once

#include <string>

#include "runtime/gaze/smoothing.h"

namespace gazeloop::report {

/// Why a stream's gaze is taken to be smoothed or not, or why that cannot be told; one sentence
/// without a full stop.
[[nodiscard]] std::string smoothing_text(const gaze::SmoothingFinding& found);

}  // namespace gazeloop::report
