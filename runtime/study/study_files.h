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

/// Writes a file of a person: mode 0600, in the place of one of that name, or to which a link of
/// that name leads, in one step. Errors (BadInput): file and reason are named; what was there
/// before then still is. A device, a pipe or a folder is none.
[[nodiscard]] Expected<void> write_private(const std::filesystem::path& file,
                                           std::string_view text);

/// Removes a subject's answers from files: sessions, which go as a whole, and lines of answers
/// (responses_file.h) or of decisions for R (analysis_report.h). Gives a line per file that says
/// what was removed; empty where nothing was. Errors (BadInput): a file that cannot be read or
/// written; those before it are done.
[[nodiscard]] Expected<std::vector<std::string>> forget(
    unsigned subject, std::span<const std::filesystem::path> files);

}  // namespace gazeloop::study
