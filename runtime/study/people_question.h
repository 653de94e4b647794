#pragma once

#include <string>
#include <vector>

#include "runtime/study/simulated_study.h"

namespace gazeloop::study {

/// Whom a study is simulated with, as it is asked for.
struct PeopleQuestion {
    SimulatedPeople people{
        .terms = {.noise = 0.5, .lapse = 0.02, .people = 0.1}, .curves = {}, .seed = 1};
    std::vector<std::string> thresholds{};  ///< levels: none, one, or one per condition
    double width = 0.4;                     ///< in ln level
    std::string trade{};  ///< differences by the metric, in place of a line; empty: none
};

/// The people of a plan. @throws SetupError (Usage) for a threshold that is no level of it, or not
/// one per condition
[[nodiscard]] SimulatedPeople people_of(const PeopleQuestion& question, const Plan& plan);

}  // namespace gazeloop::study
