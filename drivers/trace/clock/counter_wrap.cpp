#include "drivers/trace/clock/counter_wrap.h"

#include <algorithm>
#include <array>

namespace gazeloop::drivers {
namespace {

/// Counters whose range is less than so many steps are not told from clocks that were set.
constexpr std::int64_t kFewestSteps = 8;
/// Nearer to the end than this share of the range, and than so long.
constexpr std::int64_t kShare = 64;
constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kLongest_ns = 30 * kSecond_ns;

bool agrees(const std::optional<OtherwiseElapsed>& elapsed, Wide ns) {
    return elapsed && ns >= elapsed->ns - elapsed->within_ns &&
           ns <= elapsed->ns + elapsed->within_ns;
}

}  // namespace

std::optional<Wide> wrapped_range(Wide before, Wide after, std::int64_t step_ns,
                                  const std::optional<OtherwiseElapsed>& by_host,
                                  const std::optional<OtherwiseElapsed>& by_count) {
    constexpr std::array<std::uint32_t, 5> kBits{32, 31, 24, 20, 16};
    constexpr std::array<std::int64_t, 4> kTicks_ns{1'000, 1'000'000, 100, 1};
    if (after >= before) {
        return std::nullopt;
    }
    for (const std::uint32_t bits : kBits) {
        for (const std::int64_t tick_ns : kTicks_ns) {
            const Wide range = static_cast<Wide>(tick_ns) << bits;
            const Wide elapsed_ns = after + range - before;
            const std::int64_t longest_ns = by_host ? kSecond_ns : kLongest_ns;
            const Wide near = std::max<Wide>(step_ns, std::min<Wide>(range / kShare, longest_ns));
            const bool likely = elapsed_ns <= near || agrees(by_host, elapsed_ns) ||
                                (!by_host && agrees(by_count, elapsed_ns));
            const bool fits = elapsed_ns > 0 && likely && range / kFewestSteps >= step_ns;
            const bool from_zero = after >= 0 && before < range;
            const bool with_sign = after >= -range / 2 && before < range / 2;
            if (fits && (from_zero || with_sign)) {
                return range;
            }
        }
    }
    return std::nullopt;
}

std::optional<Wide> counter_range(Wide about, Wide most) {
    constexpr std::uint32_t kFewestBits = 8;
    constexpr std::uint32_t kMostBits = 32;
    constexpr Wide kWithin = 50;  // one in so many
    constexpr std::array<std::int64_t, 6> kTicks_ns{1, 100, 1'000, 10'000, 125'000, 1'000'000};
    std::optional<Wide> nearest;
    Wide least = about / kWithin;
    for (std::uint32_t bits = kFewestBits; bits <= kMostBits; ++bits) {
        for (const std::int64_t tick_ns : kTicks_ns) {
            const Wide range = static_cast<Wide>(tick_ns) << bits;
            const Wide off = range > about ? range - about : about - range;
            if (range > most && off <= least) {
                nearest = range;
                least = off;
            }
        }
    }
    return nearest;
}

}  // namespace gazeloop::drivers
