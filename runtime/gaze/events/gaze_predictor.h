#pragma once

#include <array>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>

#include "runtime/gaze/events/event_detector.h"
#include "runtime/gaze/events/prediction_check.h"
#include "runtime/gaze/events/saccade_forecast.h"
#include "runtime/gaze/events/seen_motion.h"

namespace gazeloop::gaze {

/// What one may make of the gaze that was seen last.
enum class PredictionVerdict : std::uint8_t {
    Hold,              ///< the eye rests: where it looked is the best guess
    Extrapolated,      ///< it moves on as said
    DoNotExtrapolate,  ///< it moves, or is lost, and where to is not known well enough: hold
};
inline constexpr std::array<std::string_view, 3> kPredictionVerdictNames{"hold", "extrapolated",
                                                                         "do-not-extrapolate"};

struct GazePrediction {
    PredictionVerdict verdict = PredictionVerdict::DoNotExtrapolate;
    /// From where the gaze was seen last to where it will be, in the frame of the directions; for
    /// both eyes the same. None but with Extrapolated.
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};
    std::int64_t horizon_ns = 0;  ///< how far ahead of the last sample; at most the bound
    /// Holds in 95 % of cases, if no saccade begins: it follows the source's own errors lately.
    /// None with a loss.
    std::optional<double> uncertainty_rad;
    EyeEvent event = EyeEvent::Lost;  ///< at the last sample
};

/// Where the gaze will be when a frame is shown. Causal, pure, fixed memory.
///
/// - Fixation and oscillation are held.
/// - Pursuit goes on with a share of its velocity.
/// - A saccade goes on along its way as the main sequence says (saccade_forecast.h), less some
///   deviations of that forecast and no more than a few times what it goes at least: overshooting
///   is worse than lagging, because it goes on after the landing. It is not extrapolated while it
///   is too small or too slow to tell it from noise, nor once it has slowed down, when it may end
///   at any time.
/// - Of a pursuit it believes as much as this source's latest ones bear out (prediction_check.h),
///   down to a hold.
class GazePredictor {
  public:
    /// `longest_ns`: the bound of the horizon. Beyond it the prediction is for the bound.
    explicit GazePredictor(std::int64_t longest_ns = 60'000'000) : longest_ns_(longest_ns) {}

    /// As EventDetector::add.
    void add(std::int64_t time_ns, const std::optional<glm::dvec3>& direction);
    void turn(const glm::dquat& rotation) {
        detector_.turn(rotation);
        check_.turn(rotation);
    }

    /// For a time; one that is not after the last sample is that sample's.
    [[nodiscard]] GazePrediction predict(std::int64_t time_ns) const;

    /// At the last sample.
    [[nodiscard]] SeenMotion seen() const;

    [[nodiscard]] const EventDetector& detector() const { return detector_; }

  private:
    /// Precondition: the detector sees one.
    [[nodiscard]] SaccadeInFlight saccade_as_seen() const;
    /// A forecast as it would be without what its errors have taught.
    [[nodiscard]] PredictionCheck::Forecast forecast_at(double ahead_s) const;
    void forecast_saccade(double ahead_s, PredictionCheck::Forecast& forecast) const;
    void forecast_pursuit(double ahead_s, PredictionCheck::Forecast& forecast) const;

    EventDetector detector_;
    SaccadeInFlight in_flight_;  ///< as of the last sample, in a saccade
    SaccadeForecast saccade_;    ///< of that
    PredictionCheck check_;
    std::int64_t longest_ns_;
    double vigour_ = 1.0;  ///< of this person's saccades, learned from those that have landed
};

}  // namespace gazeloop::gaze
