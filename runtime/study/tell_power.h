#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "runtime/settings/settings.h"
#include "runtime/study/people_question.h"

namespace gazeloop::study {

/// Which designs are tried on simulated people.
struct PowerRequest {
    PeopleQuestion people{};
    std::vector<std::string> plans{};  ///< files
    unsigned studies = 100;            ///< simulated for each row
    std::optional<double> minutes{};   ///< each design is repeated to about so long
    std::string json{};                ///< "-": stdout; empty: not asked for
};

/// Says on stdout how many people and minutes each design needs, unless JSON goes there. Once
/// `interrupted` is true it ends with what there is. `known`: all settings that a plan may name,
/// which are then as the plans set them. @throws SetupError: BadInput for what cannot be read or
/// written, and as people_of()
void tell_power(const PowerRequest& request, settings::Settings& known,
                const std::function<bool()>& interrupted);

}  // namespace gazeloop::study
