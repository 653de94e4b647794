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
    std::optional<std::uint64_t> last_frame{};  ///< its index; none: the session has no frame
    std::optional<std::string> last_error{};    ///< the text of the last event of the kind "error"
};

/// Whether a session's samples are told one by one, or what the recording has of them in each
/// frame.
enum class PlayedGaze : std::uint8_t {
    Samples,
    Counts,  ///< on_gaze in place of on_sample; many times faster
};

/// Whether the session has counts of all its samples. One lacks them that an older version has
/// recorded, or that ends behind its last frame, because its recorder was killed.
/// Errors (BadInput): a damaged session.
Expected<bool> has_gaze_counts(const OpenSession& session);

/// Calls observers as the loop did while the session was recorded, frame by frame in the order of
/// their indices. The memory that this takes does not depend on the session's length. For each
/// frame it calls, in this order:
///
///     on_hidden   for changes from this frame on, or from an earlier one that the file lacks
///     on_origin   likewise
///     on_sample   for what the frame consumed, and what frames that the file lacks consumed, in
///     the
///                 order of arrival
///     on_event    in the order of the run; see below
///     on_frame
///     on_gpu      if the file has the frame's GPU part
///     on_gaze     with PlayedGaze::Counts, and then no on_sample; precondition: has_gaze_counts
///
/// Changes and samples of a frame that the file lacks come with the next frame that it has.
///
/// Of events, the file keeps only their times and their order among themselves. So an event comes
/// after those before it, and before the first frame whose end (end_frame) is not earlier than the
/// event's time. If its time is unknown, it comes at once. What is left after the last frame
/// follows in the same order. on_rendered is never called: there are no pictures.
///
/// Errors (BadInput): a damaged session (file, table and row named). Observers have then been told
/// what lay before. What an observer throws passes through.
Expected<PlaybackEnd> play(const OpenSession& session,
                           std::span<frame::FrameObserver* const> observers,
                           PlayedGaze gaze = PlayedGaze::Samples);

/// The same, but the session is read on a thread of its own while observers are told on this one:
/// for who wants it soon. A few MB more of memory, whatever the length.
Expected<PlaybackEnd> play_ahead(const OpenSession& session,
                                 std::span<frame::FrameObserver* const> observers,
                                 PlayedGaze gaze = PlayedGaze::Samples);

/// The same as play() for a file. Errors: those of OpenSession::open too.
Expected<PlaybackEnd> play(const std::filesystem::path& session,
                           std::span<frame::FrameObserver* const> observers);

}  // namespace gazeloop::session
