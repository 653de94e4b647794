#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/error.h"
#include "runtime/session/session_recorder.h"

namespace gazeloop::session {

struct RecordedSample {
    std::uint64_t frame = 0;  ///< the frame that consumed it
    gaze::GazeSample sample;
};

struct RecordedFrame {
    frame::FrameRecord frame;
    frame::FrameGpuRecord gpu;  ///< with unknown stamps and no passes where the GPU part is missing
};

struct RecordedEvent {
    time::Stamp time;
    std::string kind;
    std::string text;
};

/// A session as it lies in its file, complete.
struct SessionFile {
    SessionHeader header;                 ///< as it was given to the recorder
    std::vector<RecordedSample> samples;  ///< by frame, then arrival
    std::vector<RecordedFrame> frames;    ///< by index
    std::vector<RecordedEvent> events;
    std::vector<gaze::HiddenChange> hidden;  ///< by frame
    std::uint64_t records_dropped = 0;  ///< by a full queue, as far as was known when writing ended
    bool closed_cleanly = false;
    bool writing_failed = false;       ///< and the disk still took a note of it
    bool had_write_ahead_log = false;  ///< a log with content lay beside it

    [[nodiscard]] std::optional<std::string_view> meta(std::string_view name) const;
    [[nodiscard]] std::optional<std::string_view> config(std::string_view key) const;
};

/// Reads a session, also one whose recorder was killed or is still writing: then everything up to
/// its last commit. Not-a-number comes back as the quiet one. Errors (BadInput, each naming the
/// file): missing, not a session, of a newer or too old schema (both versions named), damaged
/// (table and row named).
Expected<SessionFile> read_session(const std::filesystem::path& file);

/// Whether the file begins as SQLite files do; false too if it cannot be read.
bool looks_like_session(const std::filesystem::path& file);

}  // namespace gazeloop::session
