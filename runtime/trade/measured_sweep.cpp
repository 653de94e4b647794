#include "runtime/trade/measured_sweep.h"

#include <fmt/core.h>

#include <optional>

#include "runtime/trade/sweep_journal.h"

namespace gazeloop::trade {
namespace {

std::string of_file(const SweepRecord& record, const std::string& file) {
    return fmt::format("{}: {} comparisons and {} timed frames{}", file, record.judged.size(),
                       record.turns.size(),
                       record.torn_bytes > 0
                           ? fmt::format("; its last {} bytes are a line that was cut short, and "
                                         "measured again",
                                         record.torn_bytes)
                           : std::string());
}

}  // namespace

Expected<SweepRecord> measured_sweep(const vulkan::Context& context, const SweepQuestion& question,
                                     const std::vector<SweepPoint>& points,
                                     const SweptValues& values, settings::Settings& settings,
                                     const std::filesystem::path& journal, SweepHooks hooks) {
    auto record = begin_record(question, points, settings, context.device_name());
    if (!record) {
        return record;
    }
    std::optional<SweepJournal> kept;
    if (!journal.empty()) {
        auto opened = SweepJournal::open(journal, std::move(*record));
        if (!opened) {
            return std::unexpected(opened.error());
        }
        kept.emplace(std::move(*opened));
        record = kept->record();
        hooks.progress(of_file(*record, journal.string()));
    }
    const auto keep = [&kept](const auto& measured) {
        return kept ? kept->add(measured) : Expected<void>{};
    };
    hooks.judged = keep;
    hooks.timed = keep;
    if (auto done = sweep(context, question, values, settings, hooks, *record); !done) {
        Error error = done.error();
        if (kept && error.kind == ErrorKind::Interrupted) {
            error.message +=
                fmt::format("; the same command with --resume {} goes on", journal.string());
        }
        return std::unexpected(std::move(error));
    }
    return record;
}

Expected<SweepRecord> merged_sweep(const std::vector<std::string>& journals,
                                   const std::function<void(const std::string&)>& said) {
    std::vector<SweepRecord> records;
    for (const std::string& file : journals) {
        auto record = read_journal(file);
        if (!record) {
            return record;
        }
        said(of_file(*record, file));
        records.push_back(std::move(*record));
    }
    return merged(std::move(records), journals);
}

}  // namespace gazeloop::trade
