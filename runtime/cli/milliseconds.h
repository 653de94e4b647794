#pragma once

#include <cmath>
#include <cstdint>

namespace gazeloop::cli {

/// As settings and profiles state times. Precondition: under 292 years.
inline std::int64_t ms_to_ns(double ms) { return std::llround(ms * 1e6); }

}  // namespace gazeloop::cli
