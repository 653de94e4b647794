#pragma once

#include <vector>

#include "runtime/frame/passes.h"
#include "runtime/frame/sample_counts.h"
#include "runtime/named_value.h"
#include "runtime/session/session_meta.h"

namespace gazeloop::session {

/// What a session states about itself before its first frame. Names are unique within each list.
struct SessionHeader {
    frame::PassList passes{};          ///< names of the passes of its frames
    frame::GridList grids{};           ///< names of their grids
    SessionMeta meta{};                ///< what ran, when, by which clock, for which display
    std::vector<NamedValue> config{};  ///< every setting in force, by key
    bool study = false;                ///< it has the tables of a study
    std::vector<NamedValue> device{};  ///< Vulkan device and driver, OpenXR runtime, gaze source
};

}  // namespace gazeloop::session
