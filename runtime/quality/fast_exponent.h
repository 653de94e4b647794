#pragma once

#include <bit>
#include <cstdint>

namespace gazeloop::quality {

// Logarithm and power of 2 without branches or calls, so that loops over pixels are compiled to
// vector instructions; the same bits on every machine.

/// Within 1e-5 for normal positive numbers; 0 gives about -127.
[[nodiscard]] inline float log2_of(float x) {
    const auto bits = std::bit_cast<std::uint32_t>(x);
    const auto exponent = static_cast<std::int32_t>(bits >> 23U) - 127;
    const float t = std::bit_cast<float>((bits & 0x007f'ffffU) | 0x3f80'0000U) - 1.0F;
    // Coefficients of a fit, near log2(e) and ln(2) as its first terms must be.
    // NOLINTBEGIN(modernize-use-std-numbers)
    return static_cast<float>(exponent) +
           t * (1.44268147F +
                t * (-0.720358773F +
                     t * (0.468658879F +
                          t * (-0.301638010F + t * (0.144471096F + t * -0.0338220460F)))));
    // NOLINTEND(modernize-use-std-numbers)
}

/// Within a relative 6e-6 from -126 to 126; beyond, as at these.
[[nodiscard]] inline float exp2_of(float x) {
    x = x < -126.0F ? -126.0F : x;
    x = x > 126.0F ? 126.0F : x;
    const float up = x + 127.0F;
    const auto whole = static_cast<std::int32_t>(up);
    const float t = up - static_cast<float>(whole);
    // NOLINTBEGIN(modernize-use-std-numbers)
    return std::bit_cast<float>(whole << 23) *
           (0.999999898F +
            t * (0.693154490F +
                 t * (0.240141818F +
                      t * (0.0558603371F + t * (0.00894959042F + t * 0.00189375406F)))));
    // NOLINTEND(modernize-use-std-numbers)
}

}  // namespace gazeloop::quality
