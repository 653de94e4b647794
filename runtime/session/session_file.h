#pragma once

#include <filesystem>
#include <vector>

#include "runtime/error.h"
#include "runtime/gaze/hidden_mesh.h"
#include "runtime/gaze/origin_change.h"
#include "runtime/session/open_session.h"
#include "runtime/session/recorded_rows.h"

namespace gazeloop::session {

/// A complete session, as its file has it.
struct SessionFile : SessionInfo {
    std::vector<RecordedSample> samples;  ///< by frame, then arrival
    std::vector<RecordedFrame> frames;    ///< by index
    std::vector<RecordedEvent> events;
    std::vector<gaze::HiddenChange> hidden;   ///< by frame
    std::vector<gaze::OriginChange> origins;  ///< by frame
};

/// Reads a whole session into memory; meant for short ones. Every not-a-number comes back as the
/// quiet one. Errors: see play().
Expected<SessionFile> read_session(const std::filesystem::path& file);

}  // namespace gazeloop::session
