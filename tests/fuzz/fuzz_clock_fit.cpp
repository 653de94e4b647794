// Any stream of timestamps: a time of a sample is never after its arrival, and never more uncertain
// than its verdict says.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "runtime/time/clock_fit.h"
#include "runtime/time/span.h"

namespace {

void require(bool held) {
    if (!held) {
        std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gazeloop::time;
    constexpr std::int64_t kPollingUnit_ns = 100'000;
    ClockFit clock(size > 0 ? data[size - 1] * kPollingUnit_ns : 0);
    std::int64_t device_ns = 0;
    std::int64_t arrived_ns = 1'000'000'000'000;
    // Two bytes per sample: what both clocks advance by; the lowest bits choose a scale.
    for (std::size_t i = 0; i + 2 <= size; i += 2) {
        const auto scaled = [](std::uint8_t byte) {
            return std::int64_t{static_cast<std::int8_t>(byte)} << (8 * (byte & 7U));
        };
        device_ns = saturated(static_cast<__int128>(device_ns) + scaled(data[i]));
        arrived_ns += std::min<std::int64_t>(scaled(data[i + 1] & 0x7FU), 1'000'000'000'000);
        const ClockReading reading = clock.add(device_ns, arrived_ns);
        if (reading.verdict != ClockVerdict::Unusable) {
            require(reading.host_ns <= arrived_ns && reading.uncertainty_ns >= 0);
            require(reading.uncertainty_ns <=
                    (reading.verdict == ClockVerdict::Good ? 1'000'000 : 10'000'000));
        }
    }
    return 0;
}
