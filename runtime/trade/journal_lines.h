#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/trade/sweep_record.h"

namespace gazeloop::trade {

/// The lines of a journal, without line breaks.
[[nodiscard]] std::string header_line(const SweepRecord& record);
[[nodiscard]] std::string judged_line(const JudgedPoint& judged);
[[nodiscard]] std::string turn_line(const TimedTurn& turn);

/// Reads a line into a record. Throws nlohmann::json::exception or std::runtime_error for what is
/// not as the lines above are.
void read_header(const nlohmann::json& line, SweepRecord& record);
void read_entry(const nlohmann::json& line, SweepRecord& record);

}  // namespace gazeloop::trade
