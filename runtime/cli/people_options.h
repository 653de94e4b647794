#pragma once

#include <string>
#include <vector>

#include "runtime/command_line/command_line.h"
#include "runtime/study/simulated_study.h"

namespace gazeloop::cli {

/// Whom `study power` and `study simulate` simulate.
struct PeopleOptions {
    study::SimulatedPeople people{
        .terms = {.noise = 0.5, .lapse = 0.02, .people = 0.1}, .curves = {}, .seed = 1};
    std::vector<std::string> thresholds;
    double width = 0.4;
    std::string trade;  ///< differences by the metric, in place of a line; empty: none

    void add_to(Command app);

    /// The people of a plan. @throws SetupError (Usage) for a threshold that is no level of it, or
    /// not one per condition
    [[nodiscard]] study::SimulatedPeople of(const study::Plan& plan) const;
};

}  // namespace gazeloop::cli
