#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <limits>

#include "runtime/gaze/events/event_detector.h"
#include "runtime/gaze/events/eye_event.h"

namespace gazeloop::gaze {

/// Holds a predictor's forecasts against where the eye then was, while samples pass: a share that
/// says how much of a forecast pursuit to believe, and how much wider than stated its errors are.
/// Of this source alone, in the samples' own time: the same samples give the same bits. Fixed
/// memory, no allocation.
///
/// Forecasts are remembered every kEvery_ns for each of kHorizons_ns, and judged kNoticed_ns after
/// they fell due, when a saccade that began before is known. Where the gaze was lost, or a saccade
/// began that nobody could foresee, nothing is judged.
class PredictionCheck {
  public:
    static constexpr std::array<std::int64_t, 4> kHorizons_ns{5'000'000, 10'000'000, 20'000'000,
                                                              40'000'000};
    static constexpr std::int64_t kEvery_ns = 3'900'000;  ///< of 1 kHz every fourth sample
    static constexpr std::int64_t kNoticed_ns = 8'000'000;

    struct Forecast {
        EyeEvent event = EyeEvent::Lost;  ///< when it was made; not Lost
        glm::dvec3 from{0.0};             ///< where the gaze was then
        glm::dvec3 to{0.0};               ///< where it would be, were the share 1
        double uncertainty_rad = 0.0;     ///< were it not widened
    };

    /// After each sample of the detector: judges what is due.
    void follow(const EventDetector& detector);
    /// Whether forecasts of this time are to be remembered.
    [[nodiscard]] bool asks(std::int64_t time_ns) const { return time_ns - asked_ns_ >= kEvery_ns; }
    /// Remembers forecasts made at a time, one for each horizon. Times increase.
    void remember(std::int64_t time_ns, const std::array<Forecast, kHorizons_ns.size()>& forecasts);
    void turn(const glm::dquat& rotation);

    /// How much of the forecast movement to believe, 0 .. 1: of pursuit, the share that would have
    /// left the least squares of errors lately. 1 of other events.
    [[nodiscard]] double share(EyeEvent event, std::int64_t ahead_ns) const;
    /// What to multiply stated uncertainties by, so that they hold in 95 % of cases.
    [[nodiscard]] double widening(EyeEvent event, std::int64_t ahead_ns) const;

  private:
    struct Remembered {
        std::int64_t made_ns = 0;
        std::array<Forecast, kHorizons_ns.size()> forecasts;
    };
    /// A power of two that holds the longest horizon and what is noticed late.
    static constexpr std::size_t kMost = 16;

    struct Record {
        double with = 0.0;    ///< forecast times real movement, summed
        double square = 0.0;  ///< of the forecast movement, summed
        double widening;
    };
    static constexpr std::size_t kKinds = 4;  ///< events but for Lost

    void judge(const EventDetector& detector, const Remembered& remembered, std::size_t horizon);
    [[nodiscard]] static std::size_t horizon_of(std::int64_t ahead_ns);
    [[nodiscard]] static std::size_t kind_of(EyeEvent event) {
        return static_cast<std::size_t>(event) - 1;
    }
    [[nodiscard]] const Record& record(EyeEvent event, std::int64_t ahead_ns) const {
        return records_[kind_of(event)][horizon_of(ahead_ns)];
    }

    [[nodiscard]] static std::array<std::array<Record, kHorizons_ns.size()>, kKinds>
    first_records();

    std::array<Remembered, kMost> ring_{};
    std::uint64_t remembered_ = 0;
    std::array<std::uint64_t, kHorizons_ns.size()> judged_{};
    std::array<std::array<Record, kHorizons_ns.size()>, kKinds> records_ = first_records();
    std::int64_t asked_ns_ = std::numeric_limits<std::int64_t>::min() / 2;
    EyeEvent before_ = EyeEvent::Lost;
    std::int64_t saccade_began_ns_ = std::numeric_limits<std::int64_t>::min();
};

}  // namespace gazeloop::gaze
