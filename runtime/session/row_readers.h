#pragma once

#include <optional>

#include "runtime/gaze/hidden_mesh.h"
#include "runtime/session/record.h"
#include "runtime/session/recorded_rows.h"
#include "runtime/session/table_reader.h"

namespace gazeloop::session {

// What a session holds, one kind each, in memory of one piece. A reader moves by next(), which is
// false after the last piece, for good; row() is the piece that it stands on. Members throw
// FormatError. `version`: the file's schema.

/// By frame, then arrival.
class SampleRows {
  public:
    SampleRows(const Database& database, int version);
    bool next();
    [[nodiscard]] const RecordedSample& row() const { return row_; }

  private:
    TableReader samples_;
    RecordedSample row_;
};

/// By index.
class FrameRows {
  public:
    FrameRows(const Database& database, int version);
    bool next();
    [[nodiscard]] const RecordedFrame& row() const { return row_; }

  private:
    TableReader frames_;
    TableReader views_;
    TableReader foveae_;
    RecordedFrame row_;
};

/// By frame.
class HiddenRows {
  public:
    HiddenRows(const Database& database, int version);
    bool next();
    [[nodiscard]] const gaze::HiddenChange& row() const { return row_; }

  private:
    void look_ahead();

    std::optional<TableReader> triangles_;  ///< none in files from before there were any
    std::optional<HiddenRecord> ahead_;
    gaze::HiddenChange row_;
};

/// In the order in which they were told.
class EventRows {
  public:
    EventRows(const Database& database, int version);
    bool next();
    [[nodiscard]] const RecordedEvent& row() const { return row_; }

  private:
    TableReader events_;
    RecordedEvent row_;
};

}  // namespace gazeloop::session
