#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

#include "runtime/session/database.h"
#include "runtime/session/gaze_ledger.h"
#include "runtime/session/record.h"
#include "runtime/session/statement.h"

namespace gazeloop::session {

/// Writes records into a session file, on one thread at a time. Members throw DatabaseError. After
/// that the file stays readable up to the last commit, and nothing more can be written.
class SessionWriter {
  public:
    /// `file` must be a session as create_session() leaves it, which no one else writes.
    explicit SessionWriter(const std::filesystem::path& file);

    void begin();
    void write(const Record& record);
    /// `dropped`: how many records were lost before they came here, so far.
    void commit(std::uint64_t dropped);

    /// Notes in the session that writing failed, if the disk still allows it. What was not
    /// committed is lost.
    void mark_failed();

    /// Marks the session as closed and folds everything into the one file.
    void finish();

    /// Whether the file no longer lies where it was created (renamed or deleted).
    [[nodiscard]] bool moved() const { return database_.moved(); }

  private:
    void write_one(const SampleRecord& record);
    void write_one(const frame::FrameRecord& record);
    void write_one(const frame::FrameGpuRecord& record);
    void write_one(const EventRecord& record);
    void write_one(const HiddenRecord& record);
    void write_one(const gaze::OriginChange& record);
    void write_one(const TrialRecord& record);
    void write_one(const ResponseRecord& record);
    void write_decided_errors();
    void set_meta(std::string_view name, std::string_view value);

    Database database_;
    Statement insert_sample_;
    Statement insert_frame_;
    Statement update_gpu_;
    Statement update_gaze_error_;
    Statement insert_view_;
    Statement insert_fovea_;
    Statement insert_event_;
    Statement insert_hidden_;
    Statement insert_origin_;
    std::optional<Statement> insert_trial_;  ///< in sessions of studies, as the next one
    std::optional<Statement> insert_response_;
    Statement set_meta_;
    GazeLedger gaze_;
    std::uint64_t dropped_written_ = 0;
};

}  // namespace gazeloop::session
