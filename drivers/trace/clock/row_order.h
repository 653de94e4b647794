#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "drivers/trace/clock/counter_wrap.h"
#include "drivers/trace/clock/rows_read.h"
#include "runtime/gaze/trace_report.h"
#include "runtime/memory/long_vector.h"

namespace gazeloop::drivers {

/// So many rows further on or back a row may belong.
inline constexpr std::size_t kOrderWindow = 64;

/// A stamp may be off by so many intervals for jitter.
inline constexpr std::int64_t kJitterIntervals = 4;

/// Rows in the order of their times.
struct RowOrder {
    memory::LongVector<std::size_t> rows;  ///< indices of rows
    memory::LongVector<std::size_t>
        repeats;  ///< those left out, because they are in the file before
    std::vector<gaze::TraceFinding> findings;  ///< of rows or times put in order; repeats in none
};

/// Whether two rows hold the same report: eyes and sequence are equal. Two rows without a valid eye
/// and without a sequence may be.
[[nodiscard]] bool same_report(const RowsRead& rows, std::size_t a, std::size_t b);

/// Puts rows in order that the writer of the file mixed up: where times go back, and within
/// kOrderWindow rows the order of times is that of the sequence numbers, or leaves the rows more
/// evenly spaced than leaving out those that go back. Where times go back further, or a spike or a
/// clock that was set explains them better, the file's order stays. `at_ns` has the times of all
/// `rows`; `used` are the indices of those to look at, in the file's order; `interval_ns` is the
/// usual one. Where most steps are off by much of it, stamps jitter: while numbers, or else the
/// host's times, count on, rows stay, and the times are put in order among them in `at_ns`, if none
/// moves by more than kJitterIntervals. A file whose times and sequence run backwards as a whole is
/// turned round.
[[nodiscard]] RowOrder rows_in_order(const RowsRead& rows, std::span<Wide> at_ns,
                                     memory::LongVector<std::size_t> used,
                                     std::int64_t interval_ns);

}  // namespace gazeloop::drivers
