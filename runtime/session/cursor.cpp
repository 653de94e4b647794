#include "runtime/session/cursor.h"

#include "runtime/session/reading_error.h"
#include "runtime/session/row_readers.h"

namespace gazeloop::session {

template <typename Rows, typename Row>
Cursor<Rows, Row>::Cursor(const OpenSession& session) : session_(&session) {}
template <typename Rows, typename Row>
Cursor<Rows, Row>::Cursor(Cursor&&) noexcept = default;
template <typename Rows, typename Row>
Cursor<Rows, Row>& Cursor<Rows, Row>::operator=(Cursor&&) noexcept = default;
template <typename Rows, typename Row>
Cursor<Rows, Row>::~Cursor() = default;

template <typename Rows, typename Row>
Expected<bool> Cursor<Rows, Row>::next() {
    row_ = nullptr;
    try {
        if (rows_ == nullptr) {
            rows_ = std::make_unique<Rows>(session_->database(), session_->info().schema_version);
        }
        if (rows_->next()) {
            row_ = &rows_->row();
        }
        return row_ != nullptr;
    } catch (...) {
        return std::unexpected(reading_error(session_->file()));
    }
}

template class Cursor<EventRows, RecordedEvent>;
template class Cursor<SampleRows, RecordedSample>;
template class Cursor<FrameRows, RecordedFrame>;
template class Cursor<HiddenRows, gaze::HiddenChange>;
template class Cursor<OriginRows, gaze::OriginChange>;

Expected<bool> move_to(FrameCursor& cursor, std::uint64_t index) {
    bool more = true;
    while (more && (cursor.row() == nullptr || cursor.row()->frame.index < index)) {
        const Expected<bool> moved = cursor.next();
        if (!moved) {
            return moved;
        }
        more = *moved;
    }
    return more && cursor.row()->frame.index == index;
}

}  // namespace gazeloop::session
