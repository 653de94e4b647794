#pragma once

#include <filesystem>
#include <vector>

#include "runtime/files/file_lock.h"
#include "runtime/study/plan.h"
#include "runtime/study/trial.h"

namespace gazeloop::study {

/// What a subject has answered so far, and where the next sitting is recorded.
struct Sittings {
    std::vector<Response> responses;  ///< of all earlier ones, in their order
    std::filesystem::path next;
    files::FileLock lock;  ///< no other program asks this subject meanwhile
};

/// A study's folder holds a session per sitting, NAME.SUBJECT.SITTING.gaze, both numbers with three
/// digits at least, from 001. Makes the folder, for its owner alone, where there is none. Errors
/// (BadInput): it cannot be made or read; a session of it is damaged or of another plan; another
/// program asks the subject.
[[nodiscard]] Expected<Sittings> find_sittings(const Plan& plan, unsigned subject,
                                               const std::filesystem::path& folder);

}  // namespace gazeloop::study
