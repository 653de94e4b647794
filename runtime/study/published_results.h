#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/study/simulated_study.h"

namespace gazeloop::study {

/// What a paper's people answered, and what simulated ones who see by a metric would have.
struct PublishedResult {
    std::string plan;
    std::string question;
    std::string published;  ///< as the paper has it; "-": it does not say
    /// Where the answers of such people meet the question (true_threshold()); NaN: at no level
    /// shown.
    double truth = 0.0;
    double fitted = 0.0;  ///< over the simulated study's answers; NaN without any
    double low = 0.0;     ///< of its interval of 95 %
    double high = 0.0;
    bool outside = false;  ///< the fitted one lies beyond the levels shown
    double by_rule = 0.0;  ///< by the paper's own rule: the mean of the simulated study; NaN: none
    double by_rule_sd = 0.0;
};

/// One published study, once, with as many simulated people as it had. Of kfr-pilot and kfr-final:
/// by alpha, and the choice, the greatest sigma that 80 % called the same. Preconditions: a
/// published plan; curves for its conditions.
[[nodiscard]] std::vector<PublishedResult> against_published(const Plan& plan,
                                                             const SimulatedPeople& people);

/// A table for a terminal.
[[nodiscard]] std::string published_text(const SimulatedPeople& people,
                                         const std::vector<PublishedResult>& results);
[[nodiscard]] nlohmann::ordered_json published_json(const SimulatedPeople& people,
                                                    const std::vector<PublishedResult>& results);

}  // namespace gazeloop::study
