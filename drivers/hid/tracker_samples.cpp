#include "drivers/hid/tracker_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace gazeloop::drivers::hid {

TrackerSamples::TrackerSamples(EyeTrackerLayout layout, const ScreenGeometry& geometry,
                               const TrackerDelay& delay, std::optional<TrackerStatus> status)
    : layout_(std::move(layout)), geometry_(geometry), status_(status) {
    for (const TrackingLayout& tracking : layout_.tracking) {
        std::optional<SampleClock>& clock = clocks_.emplace_back();
        if (tracking.timestamp) {
            const TimestampField& field = *tracking.timestamp;
            clock.emplace(time::TickCounter(field.range, field.held_in(), field.tick_ns), delay);
        }
    }
}

void TrackerSamples::note(std::optional<TrackerStatus> status) {
    if (status && status != status_) {
        status_ = status;
        status_changed_ = true;
    }
}

void TrackerSamples::note_reported(const StatusReport& report) {
    // Status and rate may come in reports of their own.
    status_reported_ = status_reported_ || report.status;
    note(report.status);
}

void TrackerSamples::learn(const ScreenGeometry& geometry, std::optional<TrackerStatus> status) {
    geometry_ = geometry;
    if (!status_reported_) {
        note(status);
    }
}

std::optional<gaze::GazeSample> TrackerSamples::take(std::span<const std::uint8_t> report,
                                                     std::int64_t arrived_ns) {
    ++counts_.reports;
    const InputReport input = decode_input(layout_, report);
    tracked_last_ = std::holds_alternative<TrackingReport>(input);
    if (const auto* const status = std::get_if<StatusReport>(&input)) {
        note_reported(*status);
    }
    const auto* const tracking = std::get_if<TrackingReport>(&input);
    if (tracking == nullptr) {
        pass_clocks(arrived_ns);
        counts_.others += std::holds_alternative<OtherReport>(input) ? 1 : 0;
        return std::nullopt;
    }
    note_reported(tracking->status);
    counts_.damaged += tracking->truncated ? 1 : 0;
    const auto layout =
        std::ranges::find(layout_.tracking, tracking->report_id, &TrackingLayout::report_id);
    const bool has_eyes = layout->has_eye(gaze::Eye::Left) || layout->has_eye(gaze::Eye::Right);
    if (has_eyes) {
        eyes_ = {arrived_ns, tracking->eye_m};
    }
    if (!layout->has_gaze()) {
        pass_clocks(arrived_ns);
        return std::nullopt;  // eyes alone: the next gaze is theirs
    }
    ++counts_.samples;
    TrackingReport gaze = *tracking;
    if (!has_eyes && arrived_ns - eyes_.arrived_ns <= kEyesHoldNs) {
        gaze.eye_m = eyes_.eye_m;
    }
    gaze::GazeSample sample;
    sample.eyes = eye_rays(gaze, geometry_);
    sample.arrived = {arrived_ns, time::StampKind::Measured};

    const auto index = static_cast<std::size_t>(std::distance(layout_.tracking.begin(), layout));
    pass_clocks(arrived_ns, index);
    std::optional<SampleClock>& clock = clocks_[index];
    lost_before_last_ = 0;
    if (clock && tracking->ticks) {
        clock->stamp(*tracking->ticks, arrived_ns, sample);
        last_clock_ = index;
        lost_before_last_ = clock->lost_before_last();
        counts_.lost += lost_before_last_;
    }
    return sample;
}

void TrackerSamples::pass_clocks(std::int64_t arrived_ns, std::optional<std::size_t> but) {
    for (std::size_t i = 0; i < clocks_.size(); ++i) {
        if (clocks_[i] && i != but) {
            clocks_[i]->pass(arrived_ns);
        }
    }
}

std::optional<std::string> TrackerSamples::take_change() {
    if (std::exchange(status_changed_, false)) {
        return fmt::format("status: {}", text_of(*status_));
    }
    return last_clock_ ? clocks_[*last_clock_]->take_change() : std::nullopt;
}

const time::ClockFit* TrackerSamples::clock() const {
    return last_clock_ ? &clocks_[*last_clock_]->fit() : nullptr;
}

}  // namespace gazeloop::drivers::hid
