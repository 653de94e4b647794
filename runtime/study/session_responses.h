#pragma once

#include <filesystem>
#include <vector>

#include "runtime/study/plan.h"
#include "runtime/study/trial.h"

namespace gazeloop::study {

/// What a subject answered in a recorded session. Errors (BadInput), with the file: it is no
/// session or damaged, or what it holds cannot have come of the plan.
[[nodiscard]] Expected<std::vector<Response>> session_responses(const Plan& plan,
                                                                const std::filesystem::path& file);

/// Whose session it is; 0: no study's. Errors (BadInput): as above.
[[nodiscard]] Expected<unsigned> session_subject(const std::filesystem::path& file);

}  // namespace gazeloop::study
