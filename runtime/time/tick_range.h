#pragma once

#include <cstdint>
#include <limits>

namespace gazeloop::time {

/// The numbers that a counter runs through before it begins anew: least, least + 1, ...,
/// least + span, least. They need not be a power of two, nor begin at 0.
struct TickRange {
    std::int64_t least = 0;
    std::uint64_t span = std::numeric_limits<std::uint64_t>::max();  ///< greatest - least

    /// Of an unsigned counter of so many bits (1 to 64).
    [[nodiscard]] static constexpr TickRange of_bits(std::uint32_t bits) {
        return {.least = 0, .span = std::numeric_limits<std::uint64_t>::max() >> (64 - bits)};
    }
    /// Of a counter in two's complement of so many bits (1 to 64).
    [[nodiscard]] static constexpr TickRange of_signed_bits(std::uint32_t bits) {
        return {.least = std::numeric_limits<std::int64_t>::min() >> (64 - bits),
                .span = of_bits(bits).span};
    }

    /// `ticks` in two's complement; of a range from 0 on also above the greatest signed number.
    [[nodiscard]] constexpr bool holds(std::uint64_t ticks) const {
        return ticks - static_cast<std::uint64_t>(least) <= span;
    }

    friend constexpr bool operator==(const TickRange&, const TickRange&) = default;
};

/// The ticks from one reading of such a counter to another. Whole rounds of the counter cannot be
/// seen: of all differences the one that is nearest to `about` is taken; with 0 that is the shorter
/// way round. Readings outside the range count modulo it, so that a counter of n bits may have
/// anything above them.
[[nodiscard]] constexpr std::int64_t tick_difference(std::uint64_t from, std::uint64_t to,
                                                     const TickRange& range,
                                                     std::int64_t about = 0) {
    const __int128 round = static_cast<__int128>(range.span) + 1;
    const auto least = static_cast<std::uint64_t>(range.least);
    const __int128 difference = static_cast<__int128>(to - least) - (from - least);
    // How far it is above the least that counts as nearest: from 0 to just below a round.
    const __int128 lowest = about - round / 2;
    const __int128 above = ((difference - lowest) % round + round) % round;
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(lowest + above));
}

}  // namespace gazeloop::time
