#pragma once

#include <optional>

#include "runtime/gaze/hidden_mesh.h"
#include "runtime/session/record.h"
#include "runtime/session/recorded_rows.h"
#include "runtime/session/table_reader.h"

namespace gazeloop::session {

// Readers of what a session holds, one for each kind of row. Each holds one row in memory. next()
// moves to the next row, and is false after the last one, for good; row() is the current one.
// Members throw FormatError. `version`: the file's schema.

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

    std::optional<TableReader> triangles_;  ///< none in files that lack the table
    std::optional<HiddenRecord> ahead_;
    gaze::HiddenChange row_;
};

/// By frame, one for a frame at most.
class OriginRows {
  public:
    OriginRows(const Database& database, int version);
    bool next();
    [[nodiscard]] const gaze::OriginChange& row() const { return row_; }

  private:
    std::optional<TableReader> changes_;  ///< none in files from before there were any
    bool any_ = false;
    gaze::OriginChange row_;
};

/// In the order in which they were recorded.
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
