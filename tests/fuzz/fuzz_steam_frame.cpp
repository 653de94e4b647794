// Any bytes as a Steam Frame's file: refused, or samples that can be.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <glm/geometric.hpp>

#include "drivers/steam_frame/gaze_samples.h"

namespace {

using namespace gazeloop::drivers;
using namespace gazeloop::drivers::steam_frame;

void require(bool held) {
    if (!held) {
        std::abort();
    }
}

void require_possible(const gazeloop::gaze::GazeSample& sample) {
    for (const gazeloop::gaze::EyeRay& ray : sample.eyes) {
        require(!ray.valid || std::abs(glm::length(ray.direction) - 1.0) < 1e-9);
        require(ray.openness == -1.0 || (ray.openness >= 0.0 && ray.openness <= 1.0));
        if (ray.covariance) {
            const auto& [xx, xy, yy] = *ray.covariance;
            require(ray.valid && xx >= 0.0 && yy >= 0.0 && xx <= 1.0 + 1e-9 && yy <= 1.0 + 1e-9);
            require(xy * xy <= xx * yy + 1e-15);
        }
    }
    require(!sample.uncertainty_ns || *sample.uncertainty_ns >= 0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    GazeSamples filtered({}, Rays::Filtered);
    GazeSamples before_fusion({}, Rays::BeforeFusion);
    Image image{};
    ClockPair pair{.raw_ns = 1'000'000'000, .monotonic_ns = 2'000'000'000, .uncertainty_ns = 100};
    for (std::size_t at = 0; at < size; at += image.size()) {
        image.fill(0);
        std::copy_n(data + at, std::min(image.size(), size - at), image.begin());
        const Header header = decode_header(image);
        const auto layout = layout_of(header);
        if (!layout) {
            continue;
        }
        const GazeRecord record = decode_record(record_in(image, *layout));
        for (GazeSamples* const samples : {&filtered, &before_fusion}) {
            require_possible(samples->take(record, header.counter, pair.monotonic_ns, pair));
            while (samples->take_change()) {
            }
        }
        pair.raw_ns += 11'111'111;
        pair.monotonic_ns += 11'111'111;
    }
    return 0;
}
