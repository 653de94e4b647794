#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "drivers/trace/clock/counter_wrap.h"
#include "runtime/memory/long_vector.h"

namespace gazeloop::drivers {

/// A row with a host time.
struct LagRow {
    std::int64_t device_ns = 0;  ///< increases strictly from row to row
    Wide lag_ns = 0;             ///< host time less device time
    /// Whether a clock was set before the row for sure, so that what is before says nothing of
    /// what follows.
    bool cut = false;
};

/// How the lowest lags, those of the quickest reports, go on.
struct LagTrend {
    double slope = 0.0;  ///< lag over device time; 0 where there is too little to tell
    /// Of the slope: two lags that are d apart differ by up to d times this for its sake.
    double uncertainty = 0.0;
    double noise_ns = 0.0;     ///< by how much the lowest lag of one second and the next differ
    double height_ns = 0.0;    ///< how far above the lowest a lag lies on average
    std::int64_t span_ns = 0;  ///< of device time between rows that are less than 1 s apart
    bool known = false;        ///< whether the slope rests on enough seconds
};

/// Rests on the lowest lag of each second, of which pairs an eighth of the trace apart are
/// compared: the median of their slopes (Theil and Sen) does not mind a few steps. O(n).
[[nodiscard]] LagTrend lag_trend(std::span<const LagRow> rows);

struct LagStep {
    std::size_t at = 0;  ///< the first row after it
    Wide by_ns = 0;      ///< by how much the lowest lag is more than before
};

/// Where lags are higher, or lower, from some row on than they were before: there a clock was set.
/// Rows can be late but not early, and late ones are in time again within 10 s. So the lowest lag
/// of 2 s on one side is compared with that of 10 s on the other: lags rise where the 10 s after
/// are higher than the 2 s before, and fall where the 2 s after are lower than the 10 s before. Of
/// the rows at which they rise the first is taken, of those at which they fall the last.
///
/// A step is one of more than 2 ms and `resolution_ns` (the steps in which the clocks count) and
/// what the trend leaves open. Where one side has less than 8 rows it is more than
/// `few_rows_ns`, and more than 10 s for a rise at the end, where rows may only be late. Ascending
/// by row. O(n).
[[nodiscard]] memory::LongVector<LagStep> lag_steps(std::span<const LagRow> rows,
                                                    const LagTrend& trend, double resolution_ns,
                                                    double few_rows_ns);

}  // namespace gazeloop::drivers
