#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/latency/predicted_latency.h"

namespace gazeloop::report {

/// The parts with their least and greatest figure and the measured distribution beside them, then
/// which percentiles lie outside, in sentences.
struct PredictionTable {
    static constexpr std::array<std::string_view, 7> kHeads{"best", "worst", "min", "p50",
                                                            "p95",  "p99",   "max"};
    struct Row {
        std::string label;                             ///< a part's is indented by two blanks
        std::array<std::string, kHeads.size()> cells;  ///< milliseconds; "-": unknown
    };
    std::vector<Row> rows;
    std::vector<std::string> notes;
};
[[nodiscard]] PredictionTable prediction_table(const latency::PredictionCheck& check,
                                               const latency::SummaryReport& report);

/// The same, at most 100 columns wide, every line ended by a newline.
[[nodiscard]] std::string prediction_text(const latency::PredictionCheck& check,
                                          const latency::SummaryReport& report);

/// What the prediction says of the measured age: "; its parts allow 23.0 to 40.0 ms, and ...".
/// Without a stop; empty where there is nothing to compare.
[[nodiscard]] std::string prediction_sentence(const latency::PredictionCheck& check);

/// Milliseconds; null: unknown.
[[nodiscard]] nlohmann::ordered_json prediction_json(const latency::PredictionCheck& check);

}  // namespace gazeloop::report
