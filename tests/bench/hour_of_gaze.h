#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace gazeloop::bench {

inline constexpr const char* kHourOfGaze = "hour of 1 kHz";

/// Saccades of 1 to 12 deg every .3 s, with noise, at 1000 Hz.
[[nodiscard]] std::vector<glm::dvec3> ten_seconds_of_gaze();

/// Processor time of this thread, so that what else the machine does counts less.
[[nodiscard]] double processor_seconds();

/// What an hour of those ten seconds, over and over, takes through `add(time_ns, direction)`.
template <typename Add>
[[nodiscard]] double seconds_for_an_hour(const Add& add) {
    const std::vector<glm::dvec3> directions = ten_seconds_of_gaze();
    constexpr std::int64_t kSamples = 3'600'000;
    const double begin_s = processor_seconds();
    for (std::int64_t i = 0; i < kSamples; ++i) {
        add(i * 1'000'000, directions[static_cast<std::size_t>(i) % directions.size()]);
    }
    return processor_seconds() - begin_s;
}

/// Of the event detector alone.
[[nodiscard]] double seconds_of_detection_alone();

}  // namespace gazeloop::bench
