#pragma once

#include <filesystem>
#include <string_view>

#include "runtime/error.h"
#include "runtime/trade/sweep_record.h"

namespace gazeloop::trade {

/// A sweep's measurements as they are made, so that none is lost or made again: a line of JSON for
/// what is measured (cases, points), then one for each judged point and for each turn. A line
/// counts once it is complete: what follows the last line break is what a killed program leaves.
class SweepJournal {
  public:
    /// Reads what the file holds, cuts a torn end off, and appends from then on; a new file (or an
    /// empty one) begins with what `asked` measures. Errors (BadInput): the file cannot be read or
    /// written, is no journal, is damaged, or is that of another sweep; it names file, line and
    /// reason.
    static Expected<SweepJournal> open(const std::filesystem::path& file, SweepRecord asked);
    SweepJournal(const SweepJournal&) = delete;
    SweepJournal& operator=(const SweepJournal&) = delete;
    SweepJournal(SweepJournal&& other) noexcept;
    SweepJournal& operator=(SweepJournal&&) = delete;
    ~SweepJournal();

    /// All that was there when it was opened.
    [[nodiscard]] const SweepRecord& record() const { return record_; }

    /// Errors (BadInput): the file cannot be written (a full disk).
    Expected<void> add(const JudgedPoint& judged);
    Expected<void> add(const TimedTurn& turn);

  private:
    SweepJournal(std::filesystem::path file, int descriptor, SweepRecord record)
        : file_(std::move(file)), descriptor_(descriptor), record_(std::move(record)) {}
    Expected<void> append(const std::string& line);

    std::filesystem::path file_;
    int descriptor_;
    SweepRecord record_;
};

/// A journal's text. Errors (BadInput): not a journal, a damaged line, a case, point or pass that
/// the first line does not list; `name` stands for the file in messages.
Expected<SweepRecord> parse_journal(std::string_view text, const std::string& name);

/// Reads a journal. Errors (BadInput): as parse_journal(); the file cannot be read.
Expected<SweepRecord> read_journal(const std::filesystem::path& file);

}  // namespace gazeloop::trade
