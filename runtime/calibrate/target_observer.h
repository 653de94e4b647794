#pragma once

#include <optional>

#include "runtime/calibration/calibration_samples.h"
#include "runtime/frame/frame_observer.h"
#include "runtime/probe/patch_painter.h"

namespace gazeloop::calibrate {

/// Shows the points of a schedule over the finished pictures, one after the other, and gathers what
/// the tracker states meanwhile. Observers that read pictures come after this one. The schedule
/// begins with the first frame that is rendered, by the scene's time, so that a run in virtual time
/// does the same. Points move with the head, whose forward is taken to lie midway between those of
/// the views; both eyes see them in the same direction, as far away as the horizon.
class TargetObserver final : public frame::FrameObserver {
  public:
    /// `samples` must outlive this. `in_flight`: as in PatchPainter.
    TargetObserver(const vulkan::Context& context, std::uint32_t in_flight,
                   const calibration::TargetSchedule& schedule,
                   calibration::CalibrationSamples& samples)
        : painter_(context, in_flight),
          schedule_(schedule),
          targets_(schedule.targets()),
          samples_(&samples) {}

    void on_sample(const gaze::GazeSample& sample, std::uint64_t frame) override;
    void on_rendered(const render::FrameView& view, const gaze::FrameFovea& fovea) override;

  private:
    probe::PatchPainter painter_;
    calibration::TargetSchedule schedule_;
    std::vector<glm::dvec3> targets_;
    calibration::CalibrationSamples* samples_;
    std::optional<double> start_s_;
};

}  // namespace gazeloop::calibrate
