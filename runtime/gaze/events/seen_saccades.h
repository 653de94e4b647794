#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "runtime/gaze/events/event_detector.h"

namespace gazeloop::gaze {

/// A saccade as a tracker's samples show it.
struct SeenSaccade {
    double amplitude_deg = 0.0;   ///< from where the gaze was before to where it comes to rest
    double peak_deg_per_s = 0.0;  ///< the greatest of the speeds, as EventDetector takes them
};

/// The event detector's saccades, with amplitude and peak, while samples pass. Smoothed saccades
/// last longer than an eye's, so they may take 300 ms here. Speeds are taken over 20 ms: that much
/// is lost of a peak, on purpose, and less of it is noise; what both do to it can be reckoned
/// (GazeSmoothing does it with simulated saccades). Left out is what lies within 50 ms of a loss:
/// blinks begin and end in false saccades. In fixed memory, without allocation.
class SeenSaccades {
  public:
    /// Of its event detector.
    static constexpr EventDetector::Parameters kDetector{.longest_saccade_ns = 300'000'000,
                                                         .speed_window_ns = 20'000'000};

    /// As EventDetector::add. A saccade is told 50 ms after the gaze has come to rest.
    std::optional<SeenSaccade> add(std::int64_t time_ns,
                                   const std::optional<glm::dvec3>& direction);

    [[nodiscard]] const EventDetector& detector() const { return detector_; }

  private:
    struct Flight {
        std::int64_t begin_ns = 0;
        glm::dvec3 from{0.0, 0.0, -1.0};
        double peak_deg_per_s = 0.0;
    };
    struct Landed {
        std::int64_t at_ns = 0;
        SeenSaccade saccade;
    };

    static constexpr std::int64_t kSettle_ns = 50'000'000;

    void land(std::int64_t time_ns);

    EventDetector detector_{kDetector};
    std::optional<std::int64_t> unbroken_since_ns_;
    std::optional<Flight> flight_;
    std::optional<Landed> landed_;
};

}  // namespace gazeloop::gaze
