#pragma once

#include <cstdint>
#include <memory>

#include "runtime/error.h"
#include "runtime/gaze/hidden_mesh.h"
#include "runtime/session/open_session.h"
#include "runtime/session/recorded_rows.h"

namespace gazeloop::session {

class FrameRows;
class HiddenRows;
class SampleRows;

/// Goes through one kind of what a session holds, in memory of one piece: for those who follow a
/// recording at their own pace.
template <typename Rows, typename Row>
class Cursor {
  public:
    /// Before the first piece. The session must outlive it.
    explicit Cursor(const OpenSession& session);
    Cursor(const Cursor&) = delete;
    Cursor& operator=(const Cursor&) = delete;
    Cursor(Cursor&&) noexcept;
    Cursor& operator=(Cursor&&) noexcept;
    ~Cursor();

    /// Moves on; false after the last piece, for good. Errors (BadInput): damaged (file, table and
    /// row named).
    Expected<bool> next();

    /// Where it stands; null before the first piece, after the last one, and after an error.
    [[nodiscard]] const Row* row() const { return row_; }

  private:
    const OpenSession* session_;
    std::unique_ptr<Rows> rows_;  ///< begun by the first move
    const Row* row_ = nullptr;
};

using SampleCursor = Cursor<SampleRows, RecordedSample>;      ///< by frame, then arrival
using FrameCursor = Cursor<FrameRows, RecordedFrame>;         ///< by index
using HiddenCursor = Cursor<HiddenRows, gaze::HiddenChange>;  ///< by frame

extern template class Cursor<SampleRows, RecordedSample>;
extern template class Cursor<FrameRows, RecordedFrame>;
extern template class Cursor<HiddenRows, gaze::HiddenChange>;

/// Moves on to a frame; false if the session has none of that index. Precondition: indices do not
/// decrease from call to call.
Expected<bool> move_to(FrameCursor& cursor, std::uint64_t index);

}  // namespace gazeloop::session
