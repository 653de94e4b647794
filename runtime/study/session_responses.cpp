#include "runtime/study/session_responses.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "runtime/session/open_session.h"
#include "runtime/session/study_rows.h"
#include "runtime/study/responses_file.h"

namespace gazeloop::study {
namespace {

template <typename Enum, std::size_t Count>
std::optional<Enum> named(const std::array<std::string_view, Count>& names, std::string_view text) {
    const auto found = std::ranges::find(names, text);
    return found == names.end() ? std::nullopt
                                : std::optional(static_cast<Enum>(found - names.begin()));
}

std::optional<std::vector<double>> levels_of(std::string_view text) {
    std::vector<double> levels;
    while (!text.empty()) {
        const std::size_t comma = std::min(text.find(','), text.size());
        double level = 0.0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + comma, level);
        if (error != std::errc{} || end != text.data() + comma) {
            return std::nullopt;
        }
        levels.push_back(level);
        text.remove_prefix(std::min(comma + 1, text.size()));
    }
    return levels;
}

std::optional<Response> response_of(const session::ResponseRow& row) {
    const auto kind = named<TrialKind>(kTrialKindNames, row.kind);
    const auto answer = named<Answer>(kAnswerNames, row.answer);
    const auto fault = named<TrialFault>(kTrialFaultNames, row.fault);
    auto levels = levels_of(row.levels);
    if (!kind || !answer || !fault || !levels) {
        return std::nullopt;
    }
    return Response{.subject = row.subject,
                    .trial = {.number = row.trial,
                              .session = row.session,
                              .kind = *kind,
                              .levels = std::move(*levels),
                              .reference_first = row.reference_first},
                    .attempt = row.attempt,
                    .answer = *answer,
                    .after_s = row.after_s,
                    .fault = *fault,
                    .settled = row.settled};
}

Expected<std::vector<session::ResponseRow>> rows_of(const std::filesystem::path& file) {
    const auto session = session::OpenSession::open(file);
    if (!session) {
        return std::unexpected(session.error());
    }
    if (!session->info().missing_log.empty()) {
        // The last answers are there.
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format("{}: {}", file.string(), session->info().missing_log)});
    }
    return session::read_responses(*session);
}

}  // namespace

Expected<std::vector<Response>> session_responses(const Plan& plan,
                                                  const std::filesystem::path& file) {
    const auto rows = rows_of(file);
    if (!rows) {
        return std::unexpected(rows.error());
    }
    std::vector<Response> responses;
    for (const session::ResponseRow& row : *rows) {
        const auto bad = [&](std::string_view what) {
            return std::unexpected(Error{
                ErrorKind::BadInput,
                fmt::format("{}: response {}: {}", file.string(), responses.size() + 1, what)});
        };
        auto response = response_of(row);
        if (!response) {
            return bad("has a word that no study writes: the recording is damaged");
        }
        if (const auto checked = check_response(plan, *response); !checked) {
            return bad(checked.error().message);
        }
        responses.push_back(std::move(*response));
    }
    return responses;
}

Expected<unsigned> session_subject(const std::filesystem::path& file) {
    const auto session = session::OpenSession::open(file);
    if (!session) {
        return std::unexpected(session.error());
    }
    const auto trials = session::read_trials(*session);
    if (!trials) {
        return std::unexpected(trials.error());
    }
    return trials->empty() ? 0 : trials->front().subject;
}

}  // namespace gazeloop::study
