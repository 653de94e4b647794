#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/latency/predicted_latency.h"

namespace gazeloop::report {

/// The parts with their least and greatest figure and the measured distribution beside them, at
/// most 100 columns wide, every line ended by a newline; then which percentiles lie outside.
[[nodiscard]] std::string prediction_text(const latency::PredictionCheck& check,
                                          const latency::SummaryReport& report);

/// What the prediction says of the measured age: "; its parts allow 23.0 to 40.0 ms, and ...".
/// Without a stop; empty where there is nothing to compare.
[[nodiscard]] std::string prediction_sentence(const latency::PredictionCheck& check);

/// Milliseconds; null: unknown.
[[nodiscard]] nlohmann::ordered_json prediction_json(const latency::PredictionCheck& check);

}  // namespace gazeloop::report
