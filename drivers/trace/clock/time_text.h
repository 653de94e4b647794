#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <string>

namespace gazeloop::drivers {

/// How long, without a sign, for messages: "8.33 ms", "900 s".
[[nodiscard]] inline std::string in_words(std::int64_t ns) {
    constexpr double kSecond_ns = 1e9;
    constexpr double kRoundsToSecond_ns = 999.5e6;  // in three digits
    const double length_ns = std::abs(static_cast<double>(ns));
    if (length_ns < kRoundsToSecond_ns) {
        return fmt::format("{:.3g} ms", length_ns * 1e-6);
    }
    constexpr double kManyDigits_s = 1e5;
    const double length_s = length_ns / kSecond_ns;
    return length_s < kManyDigits_s ? fmt::format("{:.6g} s", length_s)
                                    : fmt::format("{:.0f} s", length_s);
}

}  // namespace gazeloop::drivers
