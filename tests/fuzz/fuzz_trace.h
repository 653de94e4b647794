#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>

#include "drivers/trace/read_trace.h"

namespace gazeloop::fuzz {

inline void require(bool held) {
    if (!held) {
        std::abort();
    }
}

/// Reads the rows as a trace that follows the header, and stops the fuzzer where a promise of
/// trace.h does not hold.
inline std::optional<gaze::GazeTrace> read_checked(std::string_view header,
                                                   std::span<const std::uint8_t> rows,
                                                   std::string_view format) {
    std::string text{header};
    text.append(rows.begin(), rows.end());
    std::istringstream in(text);
    const Expected<gaze::GazeTrace> trace =
        drivers::read_trace(in, "fuzz", {.format = std::string{format}});
    if (!trace) {
        require(trace.error().kind == ErrorKind::BadInput && !trace.error().message.empty());
        return std::nullopt;
    }
    require(!trace->samples.empty());
    bool any_valid = false;
    const gaze::GazeSample* before = nullptr;
    for (const gaze::GazeSample& sample : trace->samples) {
        require(before == nullptr ? sample.sampled.ns == 0
                                  : before->sampled.ns < sample.sampled.ns);
        for (const gaze::EyeRay& ray : sample.eyes) {
            any_valid = any_valid || ray.valid;
            require(!ray.valid || std::abs(glm::length(ray.direction) - 1.0) < 1e-8);
        }
        before = &sample;
    }
    require(any_valid);
    return *trace;
}

}  // namespace gazeloop::fuzz
