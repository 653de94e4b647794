#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/study/plan.h"
#include "runtime/study/trial.h"

namespace gazeloop::study {

/// Responses as CSV: a row of heads, then subject,trial,attempt,session,kind,first, a column per
/// factor, answer,after_s,settled,fault. Numbers come back to the same bits; what a trial does not
/// have is empty.
[[nodiscard]] std::string responses_csv(const Plan& plan, std::span<const Response> responses);

/// Errors (BadInput), with the line: another head than the plan's, a cell that is none of its
/// values, an answer or a level that the plan does not have.
[[nodiscard]] Expected<std::vector<Response>> responses_of(const Plan& plan, std::string_view csv,
                                                           std::string_view name);

/// Errors: as responses_of(), and a file that cannot be read or is larger than 64 MiB.
[[nodiscard]] Expected<std::vector<Response>> read_responses(const Plan& plan,
                                                             const std::filesystem::path& file);

/// Refuses what the plan cannot have led to (BadInput): a design's answer that it does not have, a
/// level or a number of levels that is not the plan's, no subject.
[[nodiscard]] Expected<void> check_response(const Plan& plan, const Response& response);

}  // namespace gazeloop::study
