// Any bytes as the transfers of a PlayStation VR2, one after the other: samples whose valid rays
// are unit vectors that look forward from eyes that are not swapped, whatever came before.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <span>

#include "drivers/psvr2/gaze_samples.h"
#include "tests/unit/drivers/psvr2/packet_bytes.h"

namespace {

using namespace gazeloop;
using namespace gazeloop::drivers::psvr2;

void require(bool held) {
    if (!held) {
        std::abort();
    }
}

void check(const gaze::GazeSample& sample) {
    const auto& [left, right] = sample.eyes;
    for (const gaze::EyeRay& ray : sample.eyes) {
        require(!ray.valid ||
                (std::abs(glm::length(ray.direction) - 1.0) < 1e-9 && ray.direction.z < 0.0));
        require(glm::length(ray.origin_m) < 0.2001);
    }
    const double apart_m = right.origin_m.x - left.origin_m.x;
    const bool placed = glm::length(left.origin_m) > 0.0 && glm::length(right.origin_m) > 0.0;
    require(!placed || !left.valid || !right.valid || apart_m > -0.0301 || apart_m < -0.0999);
    require(!sample.sampled.known() || sample.ready.ns <= sample.arrived.ns);
}

}  // namespace

// Each transfer is one byte for its length, one for what is changed in a good packet, two for
// where, then the bytes that are put there; with an uncommon length, those bytes are the transfer.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t kHead = 4;
    GazeSamples samples({.least_ns = 1'000'000, .uncertainty_ns = 0});
    std::span<const std::uint8_t> rest(data, size);
    std::int64_t now_ns = 0;
    std::uint32_t frame = 0;
    while (rest.size() >= kHead) {
        const std::size_t length = std::min<std::size_t>(rest[0], rest.size() - kHead);
        const bool raw = (rest[1] & 1U) != 0;
        const bool mirrored = (rest[1] & 2U) != 0;
        const bool turned = (rest[1] & 4U) != 0;
        const unsigned repeated = 1 + (rest[1] >> 4U);
        const std::size_t at = rest[2] | std::size_t{rest[3]} << 8U;
        const std::span<const std::uint8_t> bytes = rest.subspan(kHead, length);
        for (unsigned i = 0; i < repeated; ++i) {
            now_ns += 8'333'000;
            std::optional<gaze::GazeSample> sample;
            if (raw) {
                sample = samples.take(bytes, now_ns);
            } else {
                auto packet = tests::good_packet(now_ns / 1000, ++frame);
                for (const std::size_t eye : {92U, 164U}) {
                    packet.bytes[eye + 7] ^= mirrored ? 0x80 : 0;  // the sign of its place
                    packet.bytes[eye + 31] ^= turned ? 0x80 : 0;   // and of where it looks
                }
                std::copy_n(
                    bytes.begin(),
                    std::min(bytes.size(), packet.bytes.size() - at % packet.bytes.size()),
                    packet.bytes.begin() + static_cast<std::ptrdiff_t>(at % packet.bytes.size()));
                sample = samples.take(packet.bytes, now_ns);
            }
            if (sample) {
                check(*sample);
            }
            (void)samples.take_change();
        }
        rest = rest.subspan(kHead + length);
    }
    return 0;
}
