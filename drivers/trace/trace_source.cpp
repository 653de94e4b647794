#include "drivers/trace/trace_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <utility>

#include "runtime/gaze/new_origins.h"

namespace gazeloop::drivers {
namespace {

/// What turns and moves the world so that `first` stands at the origin and faces -Z.
gaze::Pose recentring(const gaze::Pose& first) {
    constexpr double kNearlyVertical = 1e-3;
    const glm::dvec3 forward = first.orientation * glm::dvec3{0.0, 0.0, -1.0};
    const glm::dvec3 right = first.orientation * glm::dvec3{1.0, 0.0, 0.0};
    // Looking straight up or down, the head's right still says where it faces.
    const double yaw = std::hypot(forward.x, forward.z) > kNearlyVertical
                           ? std::atan2(-forward.x, -forward.z)
                           : std::atan2(-right.z, right.x);
    const glm::dquat back = glm::angleAxis(-yaw, glm::dvec3{0.0, 1.0, 0.0});
    return {back, back * -first.position_m};
}

/// Moves all poses into the world of the first one. Times are as recorded.
void take_out_new_origins(std::vector<gaze::GazeSample>& samples) {
    const std::vector<gaze::NewOrigin> origins = gaze::new_origins(samples);
    auto next = origins.begin();
    gaze::Pose origin;  // of the world in force, in the first one
    bool first_world = true;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (next != origins.end() && next->sample == i) {
            origin = gaze::compose(origin, next->new_in_old);
            origin.orientation = glm::normalize(origin.orientation);
            first_world = false;
            ++next;
        }
        if (samples[i].head && !first_world) {
            samples[i].head = gaze::compose(origin, *samples[i].head);
        }
    }
}

void play_faster(std::vector<gaze::GazeSample>& samples, double speed) {
    const auto quicker = [speed](std::int64_t ns) {
        return std::llround(static_cast<double>(ns) / speed);
    };
    for (gaze::GazeSample& sample : samples) {
        for (time::Stamp* const stamp : {&sample.sampled, &sample.ready, &sample.arrived}) {
            stamp->ns = quicker(stamp->ns);
        }
        if (sample.uncertainty_ns) {
            sample.uncertainty_ns = quicker(*sample.uncertainty_ns);
        }
    }
}

}  // namespace

TraceSource::TraceSource(gaze::GazeTrace trace, std::int64_t start_ns, std::int64_t delay_ns,
                         double speed)
    : trace_(std::move(trace)) {
    take_out_new_origins(trace_.samples);
    if (speed != 1.0) {
        play_faster(trace_.samples, speed);
    }
    const auto first_head =
        std::find_if(trace_.samples.begin(), trace_.samples.end(),
                     [](const gaze::GazeSample& sample) { return sample.head.has_value(); });
    const gaze::Pose recentre =
        first_head != trace_.samples.end() ? recentring(*first_head->head) : gaze::Pose{};
    std::int64_t arrived_before_ns = start_ns;
    std::int64_t head_before_ns = std::numeric_limits<std::int64_t>::min();
    for (gaze::GazeSample& sample : trace_.samples) {
        const std::int64_t reported_ns =
            sample.arrived.known() ? sample.arrived.ns : sample.sampled.ns;
        for (time::Stamp* const stamp : {&sample.sampled, &sample.ready}) {
            if (stamp->known()) {
                *stamp = {start_ns + stamp->ns, time::StampKind::Modelled};
            }
        }
        arrived_before_ns = std::max(arrived_before_ns, start_ns + reported_ns + delay_ns);
        sample.arrived = {arrived_before_ns, time::StampKind::Modelled};
        if (sample.head) {
            sample.head = gaze::compose(recentre, *sample.head);
            const std::int64_t head_ns =
                sample.sampled.known() ? sample.sampled.ns : sample.arrived.ns;
            if (head_ns >= head_before_ns) {
                head_track_.add(head_ns, *sample.head);
                head_before_ns = head_ns;
            }
        }
    }
}

void TraceSource::poll(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples) {
    while (!finished() && trace_.samples[next_].arrived.ns <= now_ns) {
        samples.push_back(trace_.samples[next_++]);
    }
}

const gaze::HeadMotion* TraceSource::head_track() const {
    return head_track_.empty() ? nullptr : &head_track_;
}

std::string TraceSource::description() const {
    std::string text =
        fmt::format("trace {} ({}, {} samples", trace_.file, trace_.device, trace_.samples.size());
    const gaze::TraceReport& report = trace_.report;
    if (report.lost_by_tracker.value_or(0) > 0) {
        text += fmt::format(", {} lost by the tracker", *report.lost_by_tracker);
    }
    if (report.rows_dropped() > 0) {
        text += fmt::format(", {} dropped", report.rows_dropped());
    }
    const std::uint64_t moved = report.count(gaze::TraceFindingKind::OutOfOrder).rows;
    if (moved > 0) {
        text += fmt::format(", {} out of order", moved);
    }
    return text + ")";
}

}  // namespace gazeloop::drivers
