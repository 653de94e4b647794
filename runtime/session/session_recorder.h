#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "runtime/error.h"
#include "runtime/frame/frame_record.h"
#include "runtime/gaze/gaze_sample.h"
#include "runtime/gaze/hidden_mesh.h"
#include "runtime/session/session_header.h"

namespace gazeloop::session {

/// What happened to a recording.
struct RecordingStatus {
    std::uint64_t dropped = 0;  ///< records lost because the queue was full
    std::string failure;        ///< why writing stopped, empty if it did not
    [[nodiscard]] bool complete() const { return dropped == 0 && failure.empty(); }
};

/// Writes a session file (SQLite, WAL) from one thread of its own, fed by a bounded lock-free queue
/// with one producer, the loop. Nothing here blocks the loop or allocates on it. What was handed
/// over is committed within 50 ms, so that a process killed at any moment lacks at most the last
/// 100 ms (more only while the disk itself does not answer; then the queue holds it). A full or
/// unwritable disk ends the writing, not the loop: see close().
class SessionRecorder {
  public:
    /// Creates the file with mode 0600; a process killed meanwhile leaves a readable session or
    /// none. Errors (BadInput), after which nothing is left: the file exists already, or what an
    /// earlier session left beside it (name another or remove it); the folder is missing or not
    /// writable; the header has a name twice; the system has no memory or no thread left.
    static Expected<std::unique_ptr<SessionRecorder>> create(const std::filesystem::path& file,
                                                             const SessionHeader& header);
    /// What create() would refuse at once, without creating anything: to ask before a long set-up.
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
    /// `kind` is one word of at most 32 bytes, e.g. "session-state", "gaze-lost", "interrupted";
    /// `text` is cut after 240 bytes, between characters.
    void event(time::Stamp time, std::string_view kind, std::string_view text);

    /// Whether something has gone wrong, which the person who records may want to know at once: the
    /// writing has ended early, or the file has been moved or removed. Does not block.
    [[nodiscard]] bool in_trouble() const;
    /// What that is, empty while there is none.
    [[nodiscard]] std::string trouble() const;

    /// Writes what is queued and closes the file, so that a single file remains (while somebody
    /// reads it, its -wal and -shm stay until they have done). Idempotent; what is added later is
    /// lost. Called by the destructor.
    RecordingStatus close();

  private:
    class Impl;
    explicit SessionRecorder(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace gazeloop::session
