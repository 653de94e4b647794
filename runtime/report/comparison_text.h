#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/report/comparison.h"
#include "runtime/report/percentiles.h"

namespace gazeloop::report {

/// What changed beyond chance, line by line; what did not, in one line; what else differs between
/// the two sessions. `before` names the other session.
[[nodiscard]] std::string comparison_text(const Comparison& comparison,
                                          const Percentiles& percentiles,
                                          const std::string& before);

/// Everything that was compared. REPORT.md describes it.
[[nodiscard]] nlohmann::ordered_json comparison_json(const Comparison& comparison,
                                                     const Percentiles& percentiles,
                                                     const std::string& before);

}  // namespace gazeloop::report
