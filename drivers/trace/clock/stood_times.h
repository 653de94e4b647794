#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "runtime/memory/long_vector.h"

namespace gazeloop::drivers {

/// By the host's clock, when rows were taken over which the device's clock stood.
struct StoodTimes {
    memory::LongVector<std::int64_t> since_ns;  ///< the first row; never falls
    bool by_host = false;                       ///< at all: two host times or more could be used
};

/// The usual time from one row to the next by the host's clock, whatever its jitter and however
/// many rows it shares a time among: the median over some rows, by their number. 0: not known.
[[nodiscard]] std::int64_t host_interval_ns(std::span<const std::optional<std::int64_t>> host_ns);

/// Rows follow one another at the host's usual interval, below its times, where the quickest of
/// them touch. Where the host's clock leaves these by more than 50 ms and 8 intervals and does not
/// come back, rows are lost (a gap ahead, believed up to a day and if 4 rows vouch for what
/// follows) or it was set back (then they go on at the interval). Host times that no neighbour
/// agrees with are left out. Without host times rows follow at `interval_ns`. O(n).
[[nodiscard]] StoodTimes stood_times(std::span<const std::optional<std::int64_t>> host_ns,
                                     std::int64_t interval_ns);

}  // namespace gazeloop::drivers
