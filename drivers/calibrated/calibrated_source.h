#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "drivers/gaze_source.h"
#include "runtime/calibration/eye_calibration.h"

namespace gazeloop::drivers {

/// Another source, whose valid directions are corrected by a calibration. They are recorded
/// corrected; the calibration is among the recorded settings, and undoes it
/// (calibration::uncorrected).
class CalibratedSource final : public GazeSource {
  public:
    CalibratedSource(std::unique_ptr<GazeSource> source,
                     const calibration::Calibration& calibration)
        : source_(std::move(source)), calibration_(calibration) {}

    void poll(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples) override;
    void take_seen_depth(const gaze::SeenDepth& seen) override { source_->take_seen_depth(seen); }
    [[nodiscard]] std::vector<SourceEvent> take_events() override { return source_->take_events(); }
    [[nodiscard]] const gaze::HeadMotion* head_track() const override {
        return source_->head_track();
    }
    [[nodiscard]] bool fixed_in_head() const override { return source_->fixed_in_head(); }
    [[nodiscard]] const gaze::GazeTrace* trace() const override { return source_->trace(); }
    [[nodiscard]] bool finished() const override { return source_->finished(); }
    [[nodiscard]] std::string description() const override {
        return source_->description() + ", calibrated";
    }

  private:
    std::unique_ptr<GazeSource> source_;
    calibration::Calibration calibration_;
};

}  // namespace gazeloop::drivers
