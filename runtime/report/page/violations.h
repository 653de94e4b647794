#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/latency/budget.h"
#include "runtime/report/frame_log.h"

namespace gazeloop::report::page {

/// Frames above a limit that follow each other. One that does not know its number neither ends it
/// nor counts in it; one that the limit is not about ends it.
struct ViolationRun {
    std::size_t first = 0;  ///< row of its first frame
    std::size_t last = 0;   ///< row of its last frame
    std::uint64_t frames = 0;
    std::int64_t worst = 0;  ///< the greatest number in it
    std::size_t worst_row = 0;
};

/// What was above one limit.
struct Violations {
    std::string label;                 ///< "gaze age at display", "gpu", "periods missed"
    const DurationColumn* column;      ///< of the log
    std::int64_t limit = 0;            ///< of the column's unit; above it is a violation
    std::uint64_t known = 0;           ///< frames that are judged
    std::uint64_t frames = 0;          ///< of them above the limit
    std::vector<ViolationRun> runs{};  ///< the longest ones, by their frames, then by their worst
    std::uint64_t all_runs = 0;
};

/// Frames that were shown later than announced, then what is above each limit of the budget (none:
/// null). At most `most_runs` of each.
[[nodiscard]] std::vector<Violations> violations(const FrameLog& frames,
                                                 const latency::LatencyBudget* budget,
                                                 std::size_t most_runs);

}  // namespace gazeloop::report::page
