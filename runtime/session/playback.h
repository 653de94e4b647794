#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "runtime/error.h"
#include "runtime/frame/frame_observer.h"
#include "runtime/session/open_session.h"

namespace gazeloop::session {

/// How a recorded run ended.
struct PlaybackEnd {
    std::optional<std::uint64_t> last_frame{};  ///< its index; none: the session holds no frame
    std::optional<std::string> last_error{};    ///< the text of the last event of the kind "error"
};

/// Tells observers what the loop told its own while the session was recorded, frame by frame by
/// index, in memory that does not depend on the session's length. Of each frame:
///
///     on_hidden   changes from this frame on, or from one before it that the file lacks
///     on_sample   what it consumed, and what frames consumed that the file lacks, as it arrived
///     on_event    in the order of the run; see below
///     on_frame
///     on_gpu      if the file has the frame's GPU part
///
/// The file keeps of events only their order among themselves and their times. An event is told
/// once those before it are, before the first frame that ended (end_frame) no earlier than its
/// time; with an unknown time at once. What is left after the last frame follows in the same order.
/// on_rendered is told of nothing: there are no pictures.
///
/// Errors (BadInput): damaged (file, table and row named); observers have then been told what lay
/// before. What an observer throws passes through.
Expected<PlaybackEnd> play(const OpenSession& session,
                           std::span<frame::FrameObserver* const> observers);

/// The same of a file, with the errors of OpenSession::open too.
Expected<PlaybackEnd> play(const std::filesystem::path& session,
                           std::span<frame::FrameObserver* const> observers);

}  // namespace gazeloop::session
