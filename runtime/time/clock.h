#pragma once

#include <time.h>

#include <cstdint>

#include "runtime/time/stamp.h"

namespace gazeloop::time {

/// CLOCK_MONOTONIC, nanoseconds: the host time of every stamp.
[[nodiscard]] inline std::int64_t monotonic_ns() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

/// How long the machine has been suspended since it was started: CLOCK_MONOTONIC stands still
/// meanwhile, CLOCK_BOOTTIME does not. Too small by at most the time between the two readings.
[[nodiscard]] inline std::int64_t slept_ns() {
    timespec boot{};
    clock_gettime(CLOCK_BOOTTIME, &boot);
    return std::int64_t{boot.tv_sec} * 1'000'000'000 + boot.tv_nsec - monotonic_ns();
}

[[nodiscard]] inline Stamp measured_now() { return {monotonic_ns(), StampKind::Measured}; }

inline void sleep_until_ns(std::int64_t time_ns) {
    const timespec until{time_ns / 1'000'000'000, time_ns % 1'000'000'000};
    // A signal ends the sleep early; the loop looks at its stop flag each frame.
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
}

}  // namespace gazeloop::time
