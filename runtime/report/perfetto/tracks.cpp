#include "runtime/report/perfetto/tracks.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace gazeloop::report::perfetto {
namespace {

std::optional<std::string> unit_of(Subject subject) {
    switch (subject) {
        case Subject::GazeAge:
        case Subject::Interval:
            return "ms";
        case Subject::Shaded:
            return "samples";
        default:
            return std::nullopt;
    }
}

}  // namespace

Tracks::Tracks(TraceWriter& writer, const std::string& about) : writer_(writer) {
    root_ = ++last_id_;
    writer_.add(TrackDescription{.id = root_, .name = "gazeloop", .description = about});
}

Tracks::Lane& Tracks::add_lane(Subject subject) {
    Lanes& lanes = lanes_[static_cast<std::size_t>(subject)];
    Lane& lane = lanes.all[lanes.count];
    lane.id = ++last_id_;
    const SubjectText& text = text_of(subject);
    // Names differ, because readers merge neighbours of the same name.
    writer_.add(TrackDescription{
        .id = lane.id,
        .parent = root_,
        .name = lanes.count == 0 ? std::string(text.name)
                                 : fmt::format("{} ({})", text.name, lanes.count + 1),
        .description = std::string(text.description),
        .rank =
            static_cast<std::int32_t>(static_cast<std::size_t>(subject) * kMostLanes + lanes.count),
        .unit = unit_of(subject)});
    ++lanes.count;
    return lane;
}

TrackId Tracks::of(Subject subject) {
    const Lanes& lanes = lanes_[static_cast<std::size_t>(subject)];
    return lanes.count > 0 ? lanes.all.front().id : add_lane(subject).id;
}

std::optional<TrackId> Tracks::take(Subject subject, std::int64_t from_ns, std::int64_t to_ns) {
    Lanes& lanes = lanes_[static_cast<std::size_t>(subject)];
    const auto used = std::span(lanes.all).first(lanes.count);
    const auto free = std::ranges::find_if(
        used, [from_ns](const Lane& lane) { return lane.free_from_ns <= from_ns; });
    if (free == used.end() && lanes.count == kMostLanes) {
        return std::nullopt;
    }
    Lane& lane = free != used.end() ? *free : add_lane(subject);
    lane.free_from_ns = to_ns;
    return lane.id;
}

}  // namespace gazeloop::report::perfetto
