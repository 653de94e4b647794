// Any bytes as a tracker's report descriptor, and then as its reports: whatever layout is found in
// it, samples with rays that are unit vectors or invalid, and lengths that can be.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <span>
#include <vector>

#include "drivers/hid/eye_tracker_layout.h"
#include "drivers/hid/tracker_samples.h"

namespace {

using namespace gazeloop;
using namespace gazeloop::drivers::hid;

void require(bool held) {
    if (!held) {
        std::abort();
    }
}

void check(const gaze::GazeSample& sample) {
    for (const gaze::EyeRay& ray : sample.eyes) {
        require(!ray.valid || std::abs(glm::length(ray.direction) - 1.0) < 1e-9);
        require(std::isfinite(ray.origin_m.x) && std::isfinite(ray.origin_m.y) &&
                std::isfinite(ray.origin_m.z));
    }
    require(sample.arrived.known());
    require(!sample.sampled.known() || sample.ready.ns <= sample.arrived.ns);
}

}  // namespace

// Two bytes for the descriptor's length, the descriptor, and reports: one byte for the length, one
// for how long after its predecessor it came, and its bytes. The first reports are features too.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t kHead = 2;
    if (size < kHead) {
        return 0;
    }
    std::span<const std::uint8_t> rest(data + kHead, size - kHead);
    const std::size_t described =
        std::min<std::size_t>(data[0] | std::size_t{data[1]} << 8U, rest.size());
    const auto parsed = parse_report_descriptor(rest.first(described));
    if (!parsed) {
        return 0;
    }
    auto layout = find_eye_tracker(*parsed);
    if (!layout) {
        return 0;
    }
    rest = rest.subspan(described);
    TrackerSamples samples(*layout, {}, {.least_ns = 1'000'000, .uncertainty_ns = 0});
    std::vector<FeatureReport> reports;
    std::int64_t now_ns = 0;
    while (rest.size() >= kHead) {
        const std::size_t length = std::min<std::size_t>(rest[0], rest.size() - kHead);
        now_ns += std::int64_t{rest[1]} * 100'000;
        const std::span<const std::uint8_t> bytes = rest.subspan(kHead, length);
        if (constexpr std::size_t kFeatures = 6; !bytes.empty() && reports.size() < kFeatures) {
            reports.push_back({bytes[0], {bytes.begin(), bytes.end()}});
            const TrackerFeatures features = decode_features(*layout, reports);
            for (const auto& metres :
                 {features.minimum_distance_m, features.optimum_distance_m,
                  features.maximum_distance_m, features.maximum_width_m, features.maximum_height_m,
                  features.screen_width_m, features.screen_height_m}) {
                require(!metres || (*metres >= 0.01 && *metres <= 10.0));
            }
            samples.learn({features.screen_width_m.value_or(0.0),
                           features.screen_height_m.value_or(0.0), 0.6, 0.063},
                          features.status.status);
        }
        if (const auto sample = samples.take(bytes, now_ns)) {
            check(*sample);
        }
        (void)samples.take_change();
        rest = rest.subspan(kHead + length);
    }
    if (const auto request = encode_mode_request(*layout, kModeGaze)) {
        require(!request->empty() && request->size() <= kLongestReport + 1);
    }
    return 0;
}
