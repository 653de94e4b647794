#pragma once

#include <cmath>
#include <cstdint>

namespace gazeloop::time {

inline constexpr double kNsPerMs = 1e6;

/// As settings and profiles state times. Precondition: under 292 years.
[[nodiscard]] inline std::int64_t ms_to_ns(double ms) { return std::llround(ms * kNsPerMs); }

}  // namespace gazeloop::time
