// Any answers of a runtime: every sample's rays are directions, a known time is not ahead of its
// reading, and numbers count up by one.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <glm/geometric.hpp>
#include <numbers>

#include "drivers/openxr/gaze_reader.h"
#include "runtime/gaze/direction.h"
#include "runtime/openxr/xr_check.h"

namespace {

void require(bool held) {
    if (!held) {
        std::abort();
    }
}

/// Of the pictures whose depth is known, in part of the answers.
constexpr std::uint32_t kSide = 24;
constexpr std::size_t kSamples = std::size_t{kSide} * kSide;

/// What a runtime hands over, as it lies in memory.
struct Answer {
    std::uint8_t flags;
    std::uint8_t advance;
    XrPosef pose;
    XrVector3f eyes[2];
    std::int64_t given;
    std::int64_t host_ns;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gazeloop;
    drivers::GazeGates gates;
    drivers::GazeReader reader(size > 0 ? 0.1 * data[0] : 1.5);
    std::int64_t now_ns = 1'000'000'000'000;
    std::uint64_t sequence = 0;
    gaze::SeenDepth seen;
    for (gaze::DepthPatch& patch : seen) {
        patch.view = {
            .pose = {}, .fov = {-0.7, 0.7, 0.6, -0.6}, .width_px = kSide, .height_px = kSide};
        patch.columns = patch.rows = kSide;
    }
    for (; size >= sizeof(Answer); data += sizeof(Answer), size -= sizeof(Answer)) {
        Answer raw{};
        std::memcpy(&raw, data, sizeof raw);
        now_ns += std::int64_t{raw.advance} * 1'000'000;
        const auto flag = [&raw](unsigned bit) { return (raw.flags >> bit & 1U) != 0; };
        drivers::GazeAnswer answer{
            .focused = !flag(0),
            .bound = !flag(1),
            .active = !flag(2),
            .in_time = raw.advance % 16 != 0,
            .valid = !flag(3),
            .tracked = !flag(4),
            .pose = {},
            .time = {.given = raw.given, .host_ns = {}, .asked = now_ns, .now_ns = now_ns}};
        if (answer.valid) {
            answer.pose = openxr::from_xr(raw.pose);
        }
        if (flag(5)) {
            answer.time.host_ns = raw.host_ns;
        } else if (flag(6)) {
            answer.time.given = now_ns - raw.advance;
            answer.time.host_ns = answer.time.given;
        }
        if (flag(7)) {
            reader.place_eyes({glm::dvec3{raw.eyes[0].x, raw.eyes[0].y, raw.eyes[0].z},
                               glm::dvec3{raw.eyes[1].x, raw.eyes[1].y, raw.eyes[1].z}});
        }
        auto sample = reader.take(answer, gates);
        if (!sample) {
            continue;
        }
        if (flag(7)) {
            seen[raw.advance & 1U].nearness.assign(kSamples, static_cast<std::uint16_t>(raw.given));
        }
        if (raw.advance % 3 != 0) {
            reader.meet_at_depth(*sample, openxr::from_xr(raw.pose), seen);
        }
        require(sample->sequence == ++sequence);
        require(!sample->sampled.known() || sample->sampled.ns <= now_ns + drivers::kClockNoise_ns);
        for (const gaze::EyeRay& ray : sample->eyes) {
            require(gaze::is_finite(ray.origin_m) && gaze::is_finite(ray.direction));
            require(std::abs(glm::length(ray.direction) - 1.0) < 1e-9);
            require(!ray.valid || sample->parallax_rad.has_value());
        }
        require(sample->parallax_rad.value_or(0.0) >= 0.0 &&
                sample->parallax_rad.value_or(0.0) <= std::numbers::pi);
    }
    require(gates.take_events().size() < 1'000'000);
    return 0;
}
