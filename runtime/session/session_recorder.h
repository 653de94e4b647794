#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "runtime/error.h"
#include "runtime/frame/frame_record.h"
#include "runtime/gaze/gaze_sample.h"
#include "runtime/gaze/hidden_mesh.h"
#include "runtime/gaze/origin_change.h"
#include "runtime/session/session_header.h"
#include "runtime/session/study_rows.h"

namespace gazeloop::session {

/// What happened to a recording.
struct RecordingStatus {
    std::uint64_t dropped = 0;  ///< records lost because the queue was full
    std::string failure;        ///< why writing stopped, empty if it did not
    [[nodiscard]] bool complete() const { return dropped == 0 && failure.empty(); }
};

/// What the recorder does with a record while its queue is full.
enum class WhenFull : std::uint8_t {
    Drop,  ///< loses and counts it: real time waits for no disk
    Wait,  ///< waits for the disk: for runs whose time is not the wall's
};

/// Writes a session file (SQLite, WAL) on a thread of its own. The loop feeds it through a bounded
/// lock-free queue, as its only producer. Nothing here allocates on the loop's thread, nor blocks
/// it, unless it is to wait.
///
/// Records are committed within 50 ms, so a process killed at any moment loses at most the last 100
/// ms. Only while the disk does not answer may it lose more, which the queue then holds. A full or
/// unwritable disk ends the writing, not the loop: see close().
class SessionRecorder {
  public:
    /// Creates the file with mode 0600. A process killed meanwhile leaves a readable session or
    /// none. Errors (BadInput), after which nothing is left:
    ///  - the file exists already, or something that an earlier session left beside it (name
    ///  another
    ///    file, or remove it);
    ///  - the folder is missing or not writable;
    ///  - the header has a name twice;
    ///  - the system has no memory or no thread left.
    static Expected<std::unique_ptr<SessionRecorder>> create(const std::filesystem::path& file,
                                                             const SessionHeader& header,
                                                             WhenFull when_full = WhenFull::Drop);
    /// What create() would refuse at once, to ask before a long set-up. Creates nothing.
    static Expected<void> check(const std::filesystem::path& file);
    SessionRecorder(const SessionRecorder&) = delete;
    SessionRecorder& operator=(const SessionRecorder&) = delete;
    ~SessionRecorder();

    /// `frame` is the index of the frame that consumed the sample; it does not decrease.
    void add(const gaze::GazeSample& sample, std::uint64_t frame);
    void add(const frame::FrameRecord& record);
    void add(const frame::FrameGpuRecord& record);
    /// Frame numbers of changes do not decrease.
    void add(const gaze::HiddenChange& change);
    /// One for a frame at most.
    void add(const gaze::OriginChange& change);
    /// Of a study: these wait for a place in the queue, and are never dropped. Precondition: the
    /// header said that it is one.
    void add(const TrialRecord& record);
    void add(const ResponseRecord& record);
    /// `kind` is one word of at most 32 bytes, e.g. "session-state", "gaze-lost", "interrupted";
    /// `text` is cut after 240 bytes, between characters.
    void event(time::Stamp time, std::string_view kind, std::string_view text);

    /// Records that were lost on their way here: they count as dropped, in the file too. From any
    /// thread.
    void add_lost(std::uint64_t records);

    /// Blocks until everything added so far has been committed, so that a process killed from now
    /// on does not lose it. False: not within `patience`, or writing has ended early. On the thread
    /// that adds.
    [[nodiscard]] bool wait_until_written(std::chrono::milliseconds patience);

    /// Whether something has gone wrong that the user may want to know at once: writing has ended
    /// early, or the file has been moved or removed. Does not block.
    [[nodiscard]] bool in_trouble() const;
    /// What has gone wrong; empty if nothing has.
    [[nodiscard]] std::string trouble() const;

    /// Writes what is queued and closes the file. A single file remains; while somebody reads it,
    /// its -wal and -shm stay until the reader has closed it. Idempotent; what is added later is
    /// lost. Called by the destructor.
    RecordingStatus close();

  private:
    class Impl;
    explicit SessionRecorder(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace gazeloop::session
