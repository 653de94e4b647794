#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/calibration/calibration_fit.h"
#include "runtime/calibration/steady_gaze.h"
#include "runtime/calibration/target_schedule.h"
#include "runtime/gaze/gaze_sample.h"

namespace gazeloop::calibration {

/// Gathers what the tracker states while points are shown, and fits. Pure: who shows the points
/// says when.
class CalibrationSamples {
  public:
    CalibrationSamples(const TargetSchedule& schedule, double minimum_confidence)
        : schedule_(schedule),
          minimum_confidence_(minimum_confidence),
          steady_(schedule.targets().size()) {}

    /// The time of the schedule, seconds from its start: samples that are added from now on belong
    /// to the point that is shown then, once that has settled.
    void set_time(double seconds) {
        shown_ = schedule_.at(seconds);
        over_ = seconds >= schedule_.length_s();
    }
    /// Whether the schedule has ended.
    [[nodiscard]] bool over() const { return over_; }
    void add(const gaze::GazeSample& sample);

    /// What came of one eye. Errors: as fit_eye().
    [[nodiscard]] Expected<EyeFit> fit(gaze::Eye eye) const;

    /// Of the schedule's points, those where this eye was steady: what fit() rests on, by the
    /// schedule's order.
    [[nodiscard]] std::vector<std::size_t> steady_points(gaze::Eye eye) const;

  private:
    TargetSchedule schedule_;
    double minimum_confidence_;
    std::optional<TargetSchedule::Shown> shown_;
    bool over_ = false;
    std::vector<gaze::PerEye<SteadyGaze>> steady_;  ///< by point
};

/// What came of both eyes.
struct CalibrationResult {
    gaze::PerEye<std::optional<EyeFit>> eyes;
    gaze::PerEye<std::string> problems;             ///< why an eye has none
    gaze::PerEye<std::vector<std::size_t>> points;  ///< of the schedule, that the eye was steady at

    [[nodiscard]] bool any() const { return eyes[0].has_value() || eyes[1].has_value(); }
    [[nodiscard]] Calibration calibration() const;
};
[[nodiscard]] CalibrationResult result_of(const CalibrationSamples& samples);

/// A line per eye, for people.
[[nodiscard]] std::string result_text(const CalibrationResult& result);

}  // namespace gazeloop::calibration
