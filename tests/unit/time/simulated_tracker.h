#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "runtime/time/clock_fit.h"
#include "sim/random.h"

namespace gazeloop::time {

inline constexpr double kMs = 1e6;
inline constexpr std::int64_t kSecond_ns = 1'000'000'000;
/// The host's clock at the start, and the device's: far apart.
inline constexpr std::int64_t kHost_ns = 5'000'000 * kSecond_ns;
inline constexpr std::int64_t kDevice_ns = 77 * kSecond_ns;
inline constexpr double kLeastDelay_ns = 3.0 * kMs;

enum class Jitter { None, Uniform, Exponential };

/// A tracker with a clock of its own whose truth is known.
struct SimulatedTracker {
    double rate_hz = 120.0;
    double skew_ppm = 50.0;  ///< its second is too short by this
    Jitter jitter = Jitter::Exponential;
    double jitter_ns = 1.0 * kMs;  ///< uniform: greatest, exponential: mean
    std::uint64_t seed = 1;
    std::int64_t tick_ns = 1;  ///< of its clock
    double lost_share = 0.0;
    double polling_ns = 0.0;     ///< the host asks so often; 0: samples come by themselves
    double polling_phase = 0.0;  ///< of a period

    sim::Random random{seed, sim::Stream::Jitter};
    std::int64_t sample = 0;
    double step_ns = 0.0;  ///< of its clock so far
    double previous_arrival_ns = 0.0;

    struct Report {
        std::int64_t taken_ns = 0;  ///< host time, the truth
        std::int64_t device_ns = 0;
        std::int64_t arrived_ns = 0;
    };

    Report next() {
        while (lost_share > 0.0 && random.uniform(0.0, 1.0) < lost_share) {
            ++sample;
        }
        const double true_ns = static_cast<double>(sample++) * 1e9 / rate_hz;
        const double jitter_now = jitter == Jitter::None      ? 0.0
                                  : jitter == Jitter::Uniform ? random.uniform(0.0, jitter_ns)
                                                              : random.exponential(jitter_ns);
        double sent_ns = true_ns + jitter_now;
        if (polling_ns > 0.0) {
            constexpr double kRead_ns = 20e3;  // the host's own jitter
            sent_ns =
                (std::ceil(sent_ns / polling_ns + polling_phase) - polling_phase) * polling_ns +
                random.exponential(kRead_ns);
        }
        // Reports do not overtake each other.
        previous_arrival_ns = std::max(previous_arrival_ns, sent_ns + kLeastDelay_ns);
        const std::int64_t device_ns =
            kDevice_ns + std::llround(true_ns * (1.0 - skew_ppm * 1e-6) + step_ns);
        return {kHost_ns + std::llround(true_ns), device_ns / tick_ns * tick_ns,
                kHost_ns + std::llround(previous_arrival_ns)};
    }
};

inline double error_ns(const ClockReading& reading, const SimulatedTracker::Report& report) {
    return static_cast<double>(reading.host_ns - report.taken_ns) - kLeastDelay_ns;
}

}  // namespace gazeloop::time
