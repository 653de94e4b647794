// Datagrams from anybody: any bytes, cut into packets, are gaze or counted.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <span>

#include "drivers/datagram/osc_gaze.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    gazeloop::drivers::datagram::OscGaze gaze;
    std::span<const std::uint8_t> rest(data, size);
    std::int64_t now_ns = 0;
    while (!rest.empty()) {
        const std::size_t length = std::min<std::size_t>(rest[0] * std::size_t{4}, rest.size() - 1);
        const auto sample = gaze.take(rest.subspan(1, length), now_ns += 1'000'000);
        rest = rest.subspan(1 + length);
        if (!sample) {
            continue;
        }
        for (const auto& ray : sample->eyes) {
            const bool share = ray.openness == -1.0 || (ray.openness >= 0.0 && ray.openness <= 1.0);
            if (!share || (ray.valid && std::abs(glm::length(ray.direction) - 1.0) > 1e-9)) {
                std::abort();
            }
        }
    }
    return 0;
}
