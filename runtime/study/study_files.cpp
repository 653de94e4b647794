#include "runtime/study/study_files.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <iterator>
#include <map>
#include <tuple>

#include "runtime/open_for_reading.h"
#include "runtime/session/open_session.h"
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
    if (auto written = write_private(file, kept); !written) {
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
    for (const char* const companion : {"-wal", "-shm", ""}) {
        std::error_code error;
        std::filesystem::remove(file.string() + companion, error);
        if (error) {
            return bad(file.string() + companion,
                       fmt::format("cannot be removed ({})", error.message()));
        }
    }
    return fmt::format("{}: the session of subject {} removed, with its gaze and answers",
                       file.string(), subject);
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
    return all;
}

Expected<void> write_private(const std::filesystem::path& named, std::string_view text) {
    // What a link leads to, which would else stay as it was.
    std::error_code unknown;
    const std::filesystem::path target = std::filesystem::canonical(named, unknown);
    const std::filesystem::path& file = unknown ? named : target;
    if (!unknown && !std::filesystem::is_regular_file(file)) {
        return bad(named, "is no file: answers of persons go into files alone");
    }
    const std::string partial = file.string() + ".partial";
    const auto failed = [&](int descriptor) {
        const int error = errno;
        if (descriptor >= 0) {
            close(descriptor);
            unlink(partial.c_str());
        }
        return bad(file, fmt::format("cannot be written ({})", std::strerror(error)));
    };
    unlink(partial.c_str());
    const int descriptor = open(partial.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (descriptor < 0) {
        return failed(-1);
    }
    while (!text.empty()) {
        const ssize_t written = write(descriptor, text.data(), text.size());
        if (written < 0 && errno == EINTR) {
            continue;
        }
        if (written < 0) {
            return failed(descriptor);
        }
        text.remove_prefix(static_cast<std::size_t>(written));
    }
    if (fsync(descriptor) != 0) {
        return failed(descriptor);
    }
    close(descriptor);
    if (rename(partial.c_str(), file.c_str()) != 0) {
        const auto error = failed(-1);
        unlink(partial.c_str());
        return error;
    }
    return {};
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
