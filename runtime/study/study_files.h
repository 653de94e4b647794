#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "runtime/study/plan.h"
#include "runtime/study/trial.h"

namespace gazeloop::study {

/// The responses of several files, each a CSV (responses_file.h). Errors (BadInput): a file that
/// cannot be read or is of another plan; the same answer twice (subject, trial, attempt), with both
/// files.
[[nodiscard]] Expected<std::vector<Response>> gather(const Plan& plan,
                                                     std::span<const std::filesystem::path> files);

/// Writes a published plan; "-" is stdout. Errors (BadInput): as files::write_text(); a file is
/// there that holds anything else, which may be a plan that somebody changed.
[[nodiscard]] Expected<void> write_published_plan(const Plan& plan,
                                                  const std::filesystem::path& file);

/// Writes answers as CSV (responses_file.h), for their owner alone; "-" is stdout. Errors
/// (BadInput): as write_published_plan(); what is there may be people's own answers.
[[nodiscard]] Expected<void> write_simulated_answers(const Plan& plan,
                                                     std::span<const Response> responses,
                                                     const std::filesystem::path& file);

/// Removes a subject's answers from files: sessions, which go as a whole, and lines of answers
/// (responses_file.h) or of decisions for R (analysis_report.h). Gives a line per file that says
/// what was removed; empty where nothing was. Errors (BadInput): a file that cannot be read or
/// written; those before it are done.
[[nodiscard]] Expected<std::vector<std::string>> forget(
    unsigned subject, std::span<const std::filesystem::path> files);

}  // namespace gazeloop::study
