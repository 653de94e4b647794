#include "drivers/steam_frame/raw_clock.h"

#include <time.h>

#include "runtime/time/clock.h"
#include "runtime/time/span.h"

namespace gazeloop::drivers::steam_frame {
namespace {

std::int64_t raw_now_ns() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC_RAW, &now);
    return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

ClockPair read_once() {
    const std::int64_t before_ns = time::monotonic_ns();
    const std::int64_t raw_ns = raw_now_ns();
    const std::int64_t width_ns = time::monotonic_ns() - before_ns;
    return {.raw_ns = raw_ns,
            .monotonic_ns = before_ns + width_ns / 2,
            .uncertainty_ns = width_ns / 2 + 1};
}

}  // namespace

ClockPair read_clocks() {
    ClockPair best = read_once();
    for (int i = 0; i < 2; ++i) {
        const ClockPair pair = read_once();
        best = pair.uncertainty_ns < best.uncertainty_ns ? pair : best;
    }
    return best;
}

CarriedTime carried(std::int64_t raw_ns, const ClockPair& pair) {
    constexpr std::int64_t kPartsPerDiscipline = 2000;  // 500 ppm
    const __int128 since_ns = static_cast<__int128>(raw_ns) - pair.raw_ns;
    const __int128 apart_ns = since_ns < 0 ? -since_ns : since_ns;
    return {
        .ns = time::saturated(pair.monotonic_ns + since_ns),
        .uncertainty_ns = time::saturated(pair.uncertainty_ns + apart_ns / kPartsPerDiscipline)};
}

}  // namespace gazeloop::drivers::steam_frame
