#pragma once

#include <cstdint>

namespace gazeloop::drivers::steam_frame {

/// CLOCK_MONOTONIC_RAW and CLOCK_MONOTONIC, read together.
struct ClockPair {
    std::int64_t raw_ns = 0;
    std::int64_t monotonic_ns = 0;
    std::int64_t uncertainty_ns = 0;  ///< of their difference, either way
};

/// The pair whose readings lay closest together, of three.
[[nodiscard]] ClockPair read_clocks();

/// A time of CLOCK_MONOTONIC_RAW as one of CLOCK_MONOTONIC.
struct CarriedTime {
    std::int64_t ns = 0;
    std::int64_t uncertainty_ns = 0;  ///< either way
};

/// The kernel disciplines CLOCK_MONOTONIC by at most 500 ppm against the other one, which enters
/// the uncertainty with the time between `raw_ns` and the pair. Saturates.
[[nodiscard]] CarriedTime carried(std::int64_t raw_ns, const ClockPair& pair);

}  // namespace gazeloop::drivers::steam_frame
