#include "runtime/gaze/events/recorded_events.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

#include "runtime/gaze/direction.h"
#include "runtime/gaze/usable_direction.h"
#include "runtime/gaze/usable_pose.h"
#include "runtime/memory/long_vector.h"

namespace gazeloop::gaze {
namespace {

constexpr std::int64_t kGap_ns = 50'000'000;  // without a row is a loss, as EventDetector has it
const glm::dvec3 kNowhere{0.0};

}  // namespace

void RecordedEvents::add(const GazeSample& sample) {
    if (!sample.sampled.known() || (waiting_ && sample.sampled.ns <= waiting_->time_ns)) {
        return;
    }
    PerEye<std::optional<glm::dvec3>> directions;
    const std::optional<Pose> head = usable_pose(sample.head);
    for (std::size_t eye = 0; eye < kEyeCount; ++eye) {
        directions[eye] = usable_direction(sample.eyes[eye], 0.0);
        if (directions[eye] && head) {
            directions[eye] = unit(head->orientation * *directions[eye]);
        }
    }
    if (directions[0] || directions[1]) {
        const bool in_world = head.has_value();
        if (std::exchange(in_world_, in_world).value_or(in_world) != in_world) {
            directions = {};  // in another frame: no sequel to those before
        }
    }
    const std::optional<glm::dvec3> direction = cyclopean_.add(directions);
    detector_.add(sample.sampled.ns, direction);
    if (waiting_) {
        take(detector_.event_before().value_or(EyeEvent::Fixation));  // none yet: nothing moved
    }
    waiting_ = {sample.sampled.ns, direction};
}

void RecordedEvents::take(EyeEvent event) {
    const std::int64_t time_ns = waiting_->time_ns;
    const std::optional<glm::dvec3>& direction = waiting_->direction;
    if (!direction) {
        event = EyeEvent::Lost;
    }
    if (!open_ || open_->event != event) {
        open(event);
    }
    ++open_->samples;
    open_->end_ns = time_ns;
    if (!direction) {
        last_ = kNowhere;
        return;
    }
    if (event == EyeEvent::Lost && seen_ns_ &&
        (last_ == kNowhere || time_ns - *seen_ns_ > kGap_ns)) {
        open_->unseen_ns = time_ns - open_->begin_ns;
    }
    // The detector's velocity is now the one around this sample.
    open_->peak_deg_per_s =
        std::max(open_->peak_deg_per_s, glm::length(detector_.velocity_deg_per_s()));
    sum_ += *direction;
    seen_ns_ = time_ns;
    last_ = *direction;
}

void RecordedEvents::open(EyeEvent event) {
    const std::int64_t begin_ns =
        event == EyeEvent::Lost ? seen_ns_.value_or(waiting_->time_ns) : waiting_->time_ns;
    if (open_) {
        open_->end_ns = begin_ns;
        close();
    }
    open_ = RecordedEvent{.event = event, .begin_ns = begin_ns, .from = last_};
    if (event == EyeEvent::Saccade && detector_.event() == event) {
        open_->from = detector_.movement().from;  // noticed a little late
    }
    sum_ = kNowhere;
}

void RecordedEvents::close() {
    RecordedEvent& event = *open_;
    if (event.event == EyeEvent::Lost) {
        event.peak_deg_per_s = 0.0;
    } else {
        event.to = last_;
        event.middle = unit(sum_).value_or(kNowhere);
        // Of n unit vectors: the sum of the squared chords from their mean is n - |sum|^2 / n.
        const auto count = static_cast<double>(event.samples);
        const double scatter = 1.0 - glm::dot(sum_, sum_) / (count * count);
        event.deviation_deg = glm::degrees(std::sqrt(std::max(scatter, 0.0)));
        if (event.from != kNowhere) {
            event.amplitude_deg = glm::degrees(angle_between(event.from, event.to));
        }
    }
    events_.push_back(event);
    open_.reset();
}

memory::LongVector<RecordedEvent> RecordedEvents::finish() {
    if (waiting_) {
        take(detector_.event());
        close();
        waiting_.reset();
    }
    return std::exchange(events_, {});
}

memory::LongVector<RecordedEvent> recorded_events(const SampleRange& samples) {
    RecordedEvents events;
    for (const GazeSample& sample : samples) {
        events.add(sample);
    }
    return events.finish();
}

}  // namespace gazeloop::gaze
