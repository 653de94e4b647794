#include "runtime/gaze/events/seen_saccades.h"

#include <glm/trigonometric.hpp>
#include <utility>

#include "runtime/gaze/direction.h"

namespace gazeloop::gaze {

/// Where the gaze is now, the flight has ended.
void SeenSaccades::land(std::int64_t time_ns) {
    const Flight flight = *std::exchange(flight_, std::nullopt);
    if (flight.begin_ns - *unbroken_since_ns_ >= kSettle_ns) {
        landed_ = Landed{.at_ns = time_ns,
                         .saccade = {.amplitude_deg = glm::degrees(
                                         angle_between(flight.from, detector_.movement().from)),
                                     .peak_deg_per_s = flight.peak_deg_per_s}};
    }
}

std::optional<SeenSaccade> SeenSaccades::add(std::int64_t time_ns,
                                             const std::optional<glm::dvec3>& direction) {
    const EyeEvent before = detector_.event();
    detector_.add(time_ns, direction);
    const EyeEvent now = detector_.event();
    if (now == EyeEvent::Lost || !unbroken_since_ns_) {
        unbroken_since_ns_ = time_ns;
        flight_.reset();
        landed_.reset();
        return std::nullopt;
    }
    std::optional<SeenSaccade> told;
    if (landed_ && time_ns - landed_->at_ns >= kSettle_ns) {
        told = std::exchange(landed_, std::nullopt)->saccade;
    }
    const bool begins = now == EyeEvent::Saccade && before != EyeEvent::Saccade;
    const bool swift = now == EyeEvent::Saccade || now == EyeEvent::Oscillation;
    if (flight_ && (begins || !swift)) {
        land(time_ns);
    }
    if (now == EyeEvent::Saccade) {
        const EventDetector::Movement& movement = detector_.movement();
        flight_ = Flight{.begin_ns = movement.begin_ns,
                         .from = movement.from,
                         .peak_deg_per_s = movement.peak_deg_per_s};
    }
    return told;
}

}  // namespace gazeloop::gaze
