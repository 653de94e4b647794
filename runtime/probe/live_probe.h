#pragma once

#include "runtime/frame/frame_observer.h"
#include "runtime/probe/eye_watch.h"
#include "runtime/probe/flip_log.h"
#include "runtime/probe/patch_painter.h"

namespace gazeloop::probe {

/// Flips the patch in the frame that reads the gaze in which the eye is lost or found again, and
/// logs what the flip rested on and when it was shown. Observers that read pictures come after this
/// one.
class LiveProbe final : public frame::FrameObserver {
  public:
    /// `log` must outlive this. `in_flight`: as in PatchPainter.
    LiveProbe(const vulkan::Context& context, std::uint32_t in_flight, double minimum_confidence,
              FlipLog& log)
        : painter_(context, in_flight), watch_(minimum_confidence), log_(&log) {}

    void on_sample(const gaze::GazeSample& sample, std::uint64_t frame) override;
    void on_rendered(const render::FrameView& view, const gaze::FrameFovea& fovea) override;
    void on_frame(const frame::FrameRecord& record) override;
    void on_gpu(const frame::FrameGpuRecord& record) override;

  private:
    PatchPainter painter_;
    EyeWatch watch_;
    FlipLog* log_;
    bool flipped_ = false;  ///< in the frame that was rendered last
};

}  // namespace gazeloop::probe
