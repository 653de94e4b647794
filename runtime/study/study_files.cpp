#include "runtime/study/study_files.h"

#include <fmt/core.h>

#include <charconv>
#include <iterator>
#include <map>
#include <tuple>

#include "runtime/files/output_file.h"
#include "runtime/open_for_reading.h"
#include "runtime/session/open_session.h"
#include "runtime/study/plan_file.h"
#include "runtime/study/responses_file.h"
#include "runtime/study/session_responses.h"

namespace gazeloop::study {
namespace {

std::unexpected<Error> bad(const std::filesystem::path& file, std::string_view what) {
    return std::unexpected(Error{ErrorKind::BadInput, fmt::format("{}: {}", file.string(), what)});
}

/// The subject that a line of answers begins with; 0: none.
unsigned subject_of(std::string_view line) {
    unsigned subject = 0;
    const char* const comma = line.data() + std::min(line.find(','), line.size());
    const auto [end, error] = std::from_chars(line.data(), comma, subject);
    return error == std::errc{} && end == comma ? subject : 0;
}

Expected<std::string> forget_rows(unsigned subject, const std::filesystem::path& file) {
    auto in = open_for_reading(file);
    if (!in) {
        return bad(file, fmt::format("cannot be read ({})", in.error()));
    }
    const std::string text((std::istreambuf_iterator<char>(*in)), std::istreambuf_iterator<char>());
    // What study analyse writes for R has a comment first.
    const std::size_t head = text.starts_with('#') ? text.find('\n') + 1 : 0;
    if (!std::string_view(text).substr(head).starts_with("subject,")) {
        return bad(file, "holds no answers of a study");
    }
    std::string kept;
    std::size_t removed = 0;
    for (std::string_view left = text; !left.empty();) {
        const std::size_t end = std::min(left.find('\n'), left.size() - 1) + 1;
        if (subject_of(left.substr(0, end)) == subject) {
            ++removed;
        } else {
            kept += left.substr(0, end);
        }
        left.remove_prefix(end);
    }
    if (removed == 0) {
        return "";
    }
    if (auto written = files::write_text(file, kept, files::kOwnerOnly); !written) {
        return std::unexpected(written.error());
    }
    return fmt::format("{}: {} answers of subject {} removed", file.string(), removed, subject);
}

Expected<std::string> forget_session(unsigned subject, const std::filesystem::path& file) {
    const auto of_session = session_subject(file);
    if (!of_session) {
        return std::unexpected(of_session.error());
    }
    if (*of_session != subject) {
        return "";
    }
    const std::string real = files::followed(file).string();  // a link alone holds nothing
    for (const char* const companion : {"-wal", "-shm", ""}) {
        std::error_code error;
        std::filesystem::remove(real + companion, error);
        if (error) {
            return bad(real + companion, fmt::format("cannot be removed ({})", error.message()));
        }
    }
    return fmt::format("{}: the session of subject {} removed, with its gaze and answers",
                       file.string(), subject);
}

/// What is there already may be somebody's work, or people's answers, which cannot be had again.
Expected<void> write_where_nothing_else_is(const std::filesystem::path& file, std::string_view text,
                                           std::string_view what,
                                           const files::OutputOptions& options) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored)) {
        auto in = open_for_reading(file);
        const std::string there(in ? std::string(std::istreambuf_iterator<char>(*in), {}) : "");
        if (!there.empty() && there != text) {
            return bad(file, fmt::format("is there already and holds something else than {}, which "
                                         "would be lost: name another file, or remove it",
                                         what));
        }
    }
    return files::write_text(file, text, options);
}

}  // namespace

Expected<std::vector<Response>> gather(const Plan& plan,
                                       std::span<const std::filesystem::path> files) {
    std::vector<Response> all;
    std::map<std::tuple<unsigned, unsigned, unsigned>, std::filesystem::path> seen;
    for (const std::filesystem::path& file : files) {
        auto responses = session::looks_like_session(file) ? session_responses(plan, file)
                                                           : read_responses(plan, file);
        if (!responses) {
            return std::unexpected(responses.error());
        }
        if (responses->empty() && session::looks_like_session(file)) {
            const auto subject = session_subject(file);
            if (!subject) {
                return std::unexpected(subject.error());
            }
            if (*subject == 0) {
                return bad(file,
                           "a session that holds no trials of a study: name those that gazeloop "
                           "study run recorded");
            }
        }
        for (Response& response : *responses) {
            const auto [before, is_new] = seen.emplace(
                std::tuple{response.subject, response.trial.number, response.attempt}, file);
            if (!is_new) {
                return bad(file, fmt::format("subject {}'s answer to trial {} is in {} too: name "
                                             "each file once, or one of the two",
                                             response.subject, response.trial.number,
                                             before->second.string()));
            }
            all.push_back(std::move(response));
        }
    }
    if (all.empty() && !files.empty()) {
        return bad(files.front(), files.size() > 1 ? "holds no answers, nor do the other files"
                                                   : "holds no answers yet");
    }
    return all;
}

Expected<void> write_published_plan(const Plan& plan, const std::filesystem::path& file) {
    return write_where_nothing_else_is(file, plan_text(plan), plan.name + " as it was published",
                                       {});
}

Expected<void> write_simulated_answers(const Plan& plan, std::span<const Response> responses,
                                       const std::filesystem::path& file) {
    return write_where_nothing_else_is(file, responses_csv(plan, responses), "these answers",
                                       files::kOwnerOnly);
}

Expected<std::vector<std::string>> forget(unsigned subject,
                                          std::span<const std::filesystem::path> files) {
    std::vector<std::string> lines;
    for (const std::filesystem::path& file : files) {
        auto line = session::looks_like_session(file) ? forget_session(subject, file)
                                                      : forget_rows(subject, file);
        if (!line) {
            return std::unexpected(line.error());
        }
        lines.push_back(std::move(*line));
    }
    return lines;
}

}  // namespace gazeloop::study
