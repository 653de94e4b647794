#pragma once

#include <functional>
#include <string_view>

#include "runtime/error.h"
#include "runtime/report/frame_log.h"

namespace gazeloop::report {

/// The frames of a session as a table for other programs: one line for each, in the order of their
/// numbers; REPORT.md has the columns. Exact decimals, with a point; what is unknown is an empty
/// cell. `write` takes the text in pieces of at most 1 MB or so, and ends it with an error.
Expected<void> write_frame_csv(const FrameLog& frames,
                               const std::function<Expected<void>(std::string_view)>& write);

}  // namespace gazeloop::report
