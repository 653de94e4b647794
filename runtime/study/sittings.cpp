#include "runtime/study/sittings.h"

#include <fmt/core.h>

#include <system_error>
#include <utility>

#include "runtime/study/session_responses.h"

namespace gazeloop::study {

Expected<Sittings> find_sittings(const Plan& plan, unsigned subject,
                                 const std::filesystem::path& folder) {
    std::error_code error;
    if (std::filesystem::create_directories(folder, error)) {
        std::filesystem::permissions(folder, std::filesystem::perms::owner_all, error);
    }
    if (error) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format("{}: cannot be made ({})", folder.string(), error.message())});
    }
    auto lock = files::FileLock::take(folder / fmt::format("{}.{:03}.lock", plan.name, subject),
                                      "asks this subject");
    if (!lock) {
        return std::unexpected(lock.error());
    }
    Sittings sittings{.responses = {}, .next = {}, .lock = std::move(*lock)};
    for (unsigned sitting = 1;; ++sitting) {
        sittings.next = folder / fmt::format("{}.{:03}.{:03}.gaze", plan.name, subject, sitting);
        if (!std::filesystem::exists(sittings.next, error)) {
            return sittings;
        }
        auto responses = session_responses(plan, sittings.next);
        if (!responses) {
            return std::unexpected(responses.error());
        }
        sittings.responses.insert(sittings.responses.end(), responses->begin(), responses->end());
    }
}

}  // namespace gazeloop::study
