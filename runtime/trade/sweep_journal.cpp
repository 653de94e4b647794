#include "runtime/trade/sweep_journal.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <exception>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "runtime/open_for_reading.h"
#include "runtime/trade/journal_lines.h"

namespace gazeloop::trade {
namespace {

namespace fs = std::filesystem;

std::unexpected<Error> refuse(const std::string& name, std::string_view why) {
    return std::unexpected(Error{ErrorKind::BadInput, fmt::format("{}: {}", name, why)});
}

Expected<std::string> text_of(const fs::path& file) {
    auto in = open_regular_file(file);
    if (!in) {
        return refuse(file.string(), fmt::format("cannot be read ({})", in.error()));
    }
    std::string text{std::istreambuf_iterator<char>(*in), {}};
    if (in->bad()) {
        return refuse(file.string(), "cannot be read to its end");
    }
    return text;
}

}  // namespace

Expected<SweepRecord> parse_journal(std::string_view text, const std::string& name) {
    SweepRecord record;
    std::size_t line = 0;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        if (end == std::string_view::npos) {
            break;
        }
        ++line;
        const auto refuse_line = [&](std::string_view why) {
            return refuse(
                fmt::format("{}:{}", name, line),
                line == 1
                    ? fmt::format("is no journal of a sweep ({}): name a file that trade --resume "
                                  "wrote",
                                  why)
                    : fmt::format("is damaged ({}): delete the line to measure again what it held",
                                  why));
        };
        try {
            const auto json = nlohmann::json::parse(text.substr(0, end));
            if (line == 1) {
                read_header(json, record);
            } else {
                read_entry(json, record);
            }
        } catch (const nlohmann::json::exception&) {  // whose text is for programmers
            return refuse_line("it is not as a sweep writes it");
        } catch (const std::exception& error) {
            return refuse_line(error.what());
        }
        text.remove_prefix(end + 1);
    }
    if (line == 0) {
        return refuse(name,
                      "is no journal of a sweep (it has no complete line): name a file that trade "
                      "--resume wrote");
    }
    record.torn_bytes = text.size();
    return record;
}

Expected<SweepRecord> read_journal(const fs::path& file) {
    const auto text = text_of(file);
    return text ? parse_journal(*text, file.string()) : std::unexpected(text.error());
}

Expected<SweepJournal> SweepJournal::open(const fs::path& file, SweepRecord asked) {
    std::error_code failure;
    const bool begun = fs::exists(file, failure) && fs::file_size(file, failure) > 0;
    std::uintmax_t kept = 0;
    if (begun) {
        const auto text = text_of(file);
        if (!text) {
            return std::unexpected(text.error());
        }
        if (text->find('\n') == std::string::npos &&
            std::string_view(header_line(asked)).starts_with(*text)) {
            asked.torn_bytes = text->size();  // killed in its first line
        } else {
            auto record = parse_journal(*text, file.string());
            if (!record) {
                return std::unexpected(record.error());
            }
            const bool same_shard = record->shard == asked.shard;
            if (const std::string difference =
                    same_shard ? difference_of(*record, asked) : "another shard is asked for";
                !difference.empty()) {
                return refuse(file.string(),
                              fmt::format("holds another sweep; before and now, {}: name another "
                                          "file, or ask for the same",
                                          difference));
            }
            asked = std::move(*record);
            kept = text->size() - asked.torn_bytes;
        }
    }
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (descriptor < 0) {
        return refuse(file.string(), fmt::format("cannot be written ({})",
                                                 std::generic_category().message(errno)));
    }
    SweepJournal journal(file, descriptor, std::move(asked));
    struct stat what{};
    if (::fstat(descriptor, &what) != 0 || !S_ISREG(what.st_mode)) {
        return refuse(file.string(), "is no regular file, which a journal must be");
    }
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
        return refuse(file.string(),
                      "another sweep is writing it: wait for it, or name a file "
                      "for each shard");
    }
    if (::ftruncate(descriptor, static_cast<off_t>(kept)) != 0) {
        return refuse(file.string(), fmt::format("cannot be written ({})",
                                                 std::generic_category().message(errno)));
    }
    if (kept == 0) {
        if (auto written = journal.append(header_line(journal.record_)); !written) {
            return std::unexpected(written.error());
        }
    }
    return journal;
}

SweepJournal::SweepJournal(SweepJournal&& other) noexcept
    : file_(std::move(other.file_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      record_(std::move(other.record_)) {}

SweepJournal::~SweepJournal() {
    if (descriptor_ >= 0) {
        ::close(descriptor_);
    }
}

Expected<void> SweepJournal::add(const JudgedPoint& judged) { return append(judged_line(judged)); }

Expected<void> SweepJournal::add(const TimedTurn& turn) { return append(turn_line(turn)); }

Expected<void> SweepJournal::append(const std::string& line) {
    const std::string with_end = line + '\n';
    std::string_view left = with_end;
    while (!left.empty()) {
        const ssize_t written = ::write(descriptor_, left.data(), left.size());
        if (written < 0 && errno == EINTR) {
            continue;
        }
        if (written <= 0) {
            return refuse(file_.string(),
                          fmt::format("cannot be written ({})",
                                      std::generic_category().message(written < 0 ? errno : EIO)));
        }
        left.remove_prefix(static_cast<std::size_t>(written));
    }
    return {};
}

}  // namespace gazeloop::trade
