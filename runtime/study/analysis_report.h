#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "runtime/study/analysis.h"

namespace gazeloop::study {

/// What yes means in a plan's cells: "P(same)".
[[nodiscard]] std::string yes_name(const Plan& plan);
/// By what a subject's threshold is taken (subject_thresholds.h), in words.
[[nodiscard]] std::string rule_name(Design design);
/// "alpha 4" or "alpha 4, motion pan"; empty without a second factor.
[[nodiscard]] std::string condition_name(const Plan& plan, std::span<const double> levels);

/// For a terminal.
[[nodiscard]] std::string analysis_text(const StudyResult& result);
/// Everything that analyse() found; what is not known is null.
[[nodiscard]] nlohmann::ordered_json analysis_json(const StudyResult& result);
/// A line per cell: a column per factor, then yes,trials,share,low,high,subjects,mean,
/// standard_error.
[[nodiscard]] std::string cells_csv(const StudyResult& result);
/// A line per decision of subjects that were not excluded, for a mixed-effects logistic fit in R,
/// whose call is the first line, a comment: subject,session,trial,reference_first,a column per
/// factor,yes.
[[nodiscard]] std::string decisions_csv(const StudyResult& result,
                                        std::span<const Response> responses);

}  // namespace gazeloop::study
