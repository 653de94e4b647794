#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace gazeloop::latency {

/// Which of `count` samples in ascending order, numbered from 1, is the percentile by nearest rank.
/// None unless `percent` is in (0, 100), and when fewer than 1 / (1 - percent/100) samples exist:
/// it would only repeat the greatest one.
[[nodiscard]] inline std::optional<std::uint64_t> nearest_rank(double percent,
                                                               std::uint64_t count) {
    // Percentages such as 99.9 are not binary fractions, so products with them are taken to be off
    // by this share. It is far below one sample in any count that fits a memory.
    constexpr double kRounding = 1e-12;
    const auto samples = static_cast<double>(count);
    if (!(percent > 0.0 && percent < 100.0) ||
        samples * (100.0 - percent) < 100.0 * (1.0 - kRounding)) {
        return std::nullopt;
    }
    const double rank = std::ceil(percent * samples / 100.0 * (1.0 - kRounding));
    return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(rank));
}

}  // namespace gazeloop::latency
