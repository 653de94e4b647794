#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace gazeloop::drivers {

/// A reading or a difference of readings, ns. Clocks that count from the year 1 need more than 64
/// bits.
using Wide = __int128;

/// How long it was between two readings by something else than the clock itself.
struct OtherwiseElapsed {
    Wide ns = 0;
    Wide within_ns = 0;  ///< either way
};

/// If a clock that read `before` and then the lower `after` is a counter that began anew in
/// between: its range, to be added. The counters that are known have 16, 20, 24, 31 or 32 bits of
/// 1, 100, 1000 or 1,000,000 ns, from 0 or with a sign. The reading before must lie so near the end
/// of the range, and the one after so near its start, that together they are at most `step_ns`
/// apart, or a 64th of the range and 30 s: rows may be missing there. The host's clock (`by_host`)
/// vouches for any time that agrees with its own, and against one of more than a second that does
/// not; report numbers (`by_count`) only vouch.
[[nodiscard]] std::optional<Wide> wrapped_range(
    Wide before, Wide after, std::int64_t step_ns,
    const std::optional<OtherwiseElapsed>& by_host = std::nullopt,
    const std::optional<OtherwiseElapsed>& by_count = std::nullopt);

/// The range of a counter of 8 to 32 bits, of 1, 100, 1000, 10,000, 125,000 or 1,000,000 ns, that
/// is within 2 % of `about` ns and above `most` ns; the nearest, or none.
[[nodiscard]] std::optional<Wide> counter_range(Wide about, Wide most);

}  // namespace gazeloop::drivers
