#include "runtime/recordings/compared_gaze.h"

#include <fmt/core.h>

#include <algorithm>

#include "drivers/fixed/fixed_source.h"
#include "runtime/recordings/recorded_gaze.h"

namespace gazeloop::recordings {

Expected<ComparedGaze> ComparedGaze::parse(const std::string& text, gaze::Eye eye) {
    constexpr std::string_view kTrace = "trace:";
    ComparedGaze gaze;
    gaze.text_ = text;
    if (!text.starts_with(kTrace)) {
        const auto fixed = drivers::parse_fixed_gaze(text);
        if (!fixed) {
            return std::unexpected(fixed.error());
        }
        gaze.looked_.push_back({0, fixed->direction()});
        return gaze;
    }
    const std::string file = text.substr(kTrace.size());
    const gaze::GazeRecording trace = recorded_gaze(file, {});
    gaze.moves_ = true;
    for (const gaze::GazeSample& sample : gaze::SampleRange(*trace.samples)) {
        if (!sample.sampled.known()) {
            continue;
        }
        const std::int64_t time_ns = sample.sampled.ns;
        gaze.end_ns_ = std::max(gaze.end_ns_, time_ns);
        const gaze::EyeRay& ray = sample.eyes[gaze::index(eye)];
        if (ray.valid) {
            gaze.looked_.push_back({time_ns, ray.direction});
        }
    }
    if (gaze.looked_.empty()) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format("{}: has no valid sample of the {} eye whose time is known: name the "
                              "other --eye or another trace",
                              file, gaze::kEyeNames[gaze::index(eye)])});
    }
    std::ranges::stable_sort(gaze.looked_, {}, &Looked::time_ns);
    return gaze;
}

glm::dvec3 ComparedGaze::direction_at(std::int64_t time_ns) const {
    const auto after = std::ranges::upper_bound(looked_, time_ns, {}, &Looked::time_ns);
    return after == looked_.begin() ? after->direction : std::prev(after)->direction;
}

std::optional<std::int64_t> ComparedGaze::end_ns() const {
    return moves_ ? std::optional(end_ns_) : std::nullopt;
}

}  // namespace gazeloop::recordings
