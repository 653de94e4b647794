#pragma once

#include <cstdint>
#include <memory>

#include "runtime/error.h"
#include "runtime/gaze/hidden_mesh.h"
#include "runtime/gaze/origin_change.h"
#include "runtime/session/open_session.h"
#include "runtime/session/recorded_rows.h"

namespace gazeloop::session {

class EventRows;
class FrameRows;
class HiddenRows;
class OriginRows;
class SampleRows;

/// Goes through the rows of one kind in a session, one at a time, for readers that follow a
/// recording at their own pace. Holds one row in memory.
template <typename Rows, typename Row>
class Cursor {
  public:
    /// Starts before the first row. The session must outlive it.
    explicit Cursor(const OpenSession& session);
    Cursor(const Cursor&) = delete;
    Cursor& operator=(const Cursor&) = delete;
    Cursor(Cursor&&) noexcept;
    Cursor& operator=(Cursor&&) noexcept;
    ~Cursor();

    /// Moves to the next row; false after the last one, for good. Errors (BadInput): a damaged
    /// session (file, table and row named).
    Expected<bool> next();

    /// The current row; null before the first one, after the last one, and after an error.
    [[nodiscard]] const Row* row() const { return row_; }

  private:
    const OpenSession* session_;
    std::unique_ptr<Rows> rows_;  ///< made by the first next()
    const Row* row_ = nullptr;
};

using EventCursor = Cursor<EventRows, RecordedEvent>;         ///< in the order of the run
using SampleCursor = Cursor<SampleRows, RecordedSample>;      ///< by frame, then arrival
using FrameCursor = Cursor<FrameRows, RecordedFrame>;         ///< by index
using HiddenCursor = Cursor<HiddenRows, gaze::HiddenChange>;  ///< by frame
using OriginCursor = Cursor<OriginRows, gaze::OriginChange>;  ///< by frame

extern template class Cursor<EventRows, RecordedEvent>;
extern template class Cursor<SampleRows, RecordedSample>;
extern template class Cursor<FrameRows, RecordedFrame>;
extern template class Cursor<HiddenRows, gaze::HiddenChange>;
extern template class Cursor<OriginRows, gaze::OriginChange>;

/// Moves on to the frame of this index; false if the session has none. Precondition: indices do not
/// decrease from call to call.
Expected<bool> move_to(FrameCursor& cursor, std::uint64_t index);

}  // namespace gazeloop::session
