#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "runtime/study/power.h"

namespace gazeloop::study {

/// A design's rows, one per number of subjects.
struct PowerOfPlan {
    std::string name;
    double true_level = 0.0;  ///< of the first condition; NaN: none within the plan's levels
    bool logarithmic = true;
    std::vector<PowerRow> rows;
};

/// For a terminal: one table; half widths as factors of the level, where levels are logarithmic.
[[nodiscard]] std::string power_text(const SimulatedPeople& people,
                                     std::span<const PowerOfPlan> plans);
[[nodiscard]] nlohmann::ordered_json power_json(const SimulatedPeople& people,
                                                std::span<const PowerOfPlan> plans);

}  // namespace gazeloop::study
