#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "drivers/trace/clock/rows_read.h"
#include "drivers/trace/clock/trace_row.h"
#include "runtime/gaze/trace_report.h"

namespace gazeloop::drivers {

inline constexpr std::int64_t kUs = 1'000;
inline constexpr std::int64_t kMs = 1'000'000;
inline constexpr std::int64_t kSecond = 1'000'000'000;

/// `count` good rows at 120 Hz from line 2 on, numbered from 0, both eyes valid and no two alike;
/// the device's clock starts at `start` (a tick is 1 ns). Without host times.
inline std::vector<TraceRow> good_rows(std::size_t count, std::int64_t start = 3 * kSecond,
                                       std::int64_t interval_ns = 8'333'333) {
    std::vector<TraceRow> rows(count);
    for (std::size_t i = 0; i < count; ++i) {
        TraceRow& row = rows[i];
        row.line = i + 2;
        row.sequence = i;
        row.device_ticks = start + static_cast<std::int64_t>(i) * interval_ns;
        for (gaze::EyeRay& ray : row.eyes) {
            ray.valid = true;
            ray.openness = static_cast<double>(i) / static_cast<double>(count);
        }
    }
    return rows;
}

/// The same with host times `offset_ns` after the device's.
inline std::vector<TraceRow> with_host(std::vector<TraceRow> rows, std::int64_t offset_ns) {
    for (TraceRow& row : rows) {
        row.host_ns = *row.device_ticks + offset_ns;
    }
    return rows;
}

inline std::vector<TraceRow> without_sequence(std::vector<TraceRow> rows) {
    for (TraceRow& row : rows) {
        row.sequence.reset();
    }
    return rows;
}

/// Rows from `first` to before `end` have their device times moved by `by`.
inline void move_times(std::vector<TraceRow>& rows, std::size_t first, std::size_t end,
                       std::int64_t by) {
    for (std::size_t i = first; i < end; ++i) {
        *rows[i].device_ticks += by;
    }
}

/// The findings of one kind.
inline std::vector<gaze::TraceFinding> of_kind(const std::vector<gaze::TraceFinding>& findings,
                                               gaze::TraceFindingKind kind) {
    std::vector<gaze::TraceFinding> found;
    for (const gaze::TraceFinding& finding : findings) {
        if (finding.kind == kind) {
            found.push_back(finding);
        }
    }
    return found;
}

}  // namespace gazeloop::drivers
