#include "runtime/report/eye_events.h"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>

#include "runtime/gaze/loss_machine.h"
#include "runtime/gaze/usable_direction.h"
#include "runtime/gaze/usable_pose.h"

namespace gazeloop::report {

void EyeEvents::Line::add(std::int64_t time_ns, gaze::EyeEvent event) {
    if (!changes_.empty() && time_ns <= until_ns_) {
        return;
    }
    // Where nobody looked for long, the event before does not go on.
    const bool after_gap = !changes_.empty() && static_cast<__int128>(time_ns) - until_ns_ >
                                                    static_cast<__int128>(2) * kNear_ns;
    if (after_gap && changes_.back().event != gaze::EyeEvent::Lost) {
        changes_.push_back({until_ns_ + kNear_ns, gaze::EyeEvent::Lost});
    }
    if (changes_.empty() || changes_.back().event != event) {
        changes_.push_back({time_ns, event});
    }
    until_ns_ = time_ns;
}

std::optional<gaze::EyeEvent> EyeEvents::Line::at(std::int64_t time_ns) const {
    const auto next = std::ranges::upper_bound(changes_, time_ns, {}, &Change::time_ns);
    if (next == changes_.begin() || static_cast<__int128>(time_ns) - until_ns_ > kNear_ns) {
        return std::nullopt;
    }
    return (next - 1)->event;
}

void EyeEvents::on_sample(const gaze::GazeSample& sample, std::uint64_t) {
    if (!sample.sampled.known()) {
        return;
    }
    gaze::PerEye<std::optional<glm::dvec3>> eyes;
    bool seen = false;
    for (const gaze::Eye eye : gaze::kEyes) {
        constexpr double kMinimum = gaze::LossPolicy{}.minimum_confidence;
        auto& direction = eyes[gaze::index(eye)];
        direction = gaze::usable_direction(sample.eyes[gaze::index(eye)], kMinimum);
        seen = seen || direction.has_value();
    }
    if (seen) {
        motion_.add(sample.sampled.ns, eyes, gaze::usable_pose(sample.head));
    } else {
        motion_.lose(sample.sampled.ns);
    }
    found_.add(sample.sampled.ns, motion_.event());
}

void EyeEvents::on_origin(const gaze::OriginChange& change) {
    motion_.turn_world(glm::conjugate(change.new_in_old.orientation));
}

void EyeEvents::on_frame(const frame::FrameRecord& record) {
    const gaze::FoveaPoint& fovea = record.fovea.eyes.front();
    if (!record.should_render || !fovea.event) {
        return;
    }
    // The event is that of the newest sample; held gaze is older, and of the time of the latch.
    const bool fresh =
        fovea.state == gaze::FoveaState::Tracking || fovea.state == gaze::FoveaState::OtherEye;
    const time::Stamp& at = fresh ? fovea.sampled : record.stamps.latch;
    if (at.known()) {
        recorded_.add(at.ns, *fovea.event);
    }
}

EyeEventSource EyeEvents::source() const {
    return !recorded_.empty() ? EyeEventSource::Recorded
           : !found_.empty()  ? EyeEventSource::Found
                              : EyeEventSource::None;
}

std::optional<gaze::EyeEvent> EyeEvents::at(std::int64_t time_ns) const {
    return recorded_.empty() ? found_.at(time_ns) : recorded_.at(time_ns);
}

}  // namespace gazeloop::report
