#pragma once

#include <cstdint>
#include <optional>

#include "runtime/gaze/events/cyclopean_gaze.h"
#include "runtime/gaze/events/event_detector.h"
#include "runtime/gaze/gaze_sample.h"
#include "runtime/gaze/sample_range.h"
#include "runtime/memory/long_vector.h"

namespace gazeloop::gaze {

/// A time in which the eyes did one thing.
struct RecordedEvent {
    EyeEvent event = EyeEvent::Lost;
    std::int64_t begin_ns = 0;  ///< of its first sample; of a loss, of the last sample before it
    std::int64_t end_ns = 0;  ///< where the next event begins; of the last one, of its last sample
    std::uint64_t samples = 0;
    /// The gaze just before it and at its last sample, unit vectors; zero where it was lost.
    glm::dvec3 from{0.0};
    glm::dvec3 to{0.0};
    glm::dvec3 middle{0.0};       ///< mean direction, a unit vector; zero with a loss
    double amplitude_deg = 0.0;   ///< between from and to; 0 where one is not known
    double peak_deg_per_s = 0.0;  ///< the greatest speed, in EventDetector's window
    double deviation_deg = 0.0;   ///< root mean square of the distances from the middle
    /// Of a loss: from the last sample with gaze to the next one; 0: the gaze was there all the
    /// time, but no eye's. The rest of the event is how long the gaze then takes to settle.
    std::int64_t unseen_ns = 0;

    [[nodiscard]] double duration_ms() const {
        return static_cast<double>(end_ns - begin_ns) * 1e-6;
    }
};

/// Lists what the eyes did in a recording: EventDetector's word on each sample, in world where the
/// head is known, else in the head. Memory grows with events, some 8 a second, not with samples.
class RecordedEvents {
  public:
    /// In the order of arrival. Samples whose time is unknown or goes back are left out.
    void add(const GazeSample& sample);
    /// All events, in the order of their times, without time between them. After the last sample.
    [[nodiscard]] memory::LongVector<RecordedEvent> finish();

  private:
    /// A sample whose event the detector has yet to tell.
    struct Waiting {
        std::int64_t time_ns = 0;
        std::optional<glm::dvec3> direction;
    };
    void take(EyeEvent event);
    void open(EyeEvent event);
    void close();

    EventDetector detector_;
    CyclopeanGaze cyclopean_;
    std::optional<Waiting> waiting_;
    std::optional<bool> in_world_;
    std::optional<RecordedEvent> open_;
    glm::dvec3 sum_{0.0};                  ///< of the open event's directions
    std::optional<std::int64_t> seen_ns_;  ///< the last sample with gaze
    glm::dvec3 last_{0.0};                 ///< where it was; zero once it is lost
    memory::LongVector<RecordedEvent> events_;
};

/// All of a recording's.
[[nodiscard]] memory::LongVector<RecordedEvent> recorded_events(const SampleRange& samples);

}  // namespace gazeloop::gaze
