#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "drivers/gaze_source.h"
#include "runtime/gaze/gaze_trace.h"
#include "runtime/gaze/head_track.h"

namespace gazeloop::drivers {

/// Plays a trace once. All its times are Modelled; what the trace does not know stays unknown.
///
/// The world is turned about +Y and moved. The first known head pose then stands at the origin and
/// looks along -Z as seen from above; its pitch and roll stay.
///
/// Where the recorded origin moves later (gaze/new_origins.h), it is taken out in the same way:
/// head and views of a replay do not turn, because the head that was recorded did not, and the
/// foveae stay where the gaze is. The pose after the jump is where the one before it was, and what
/// follows is relative to that.
class TraceSource final : public GazeSource {
  public:
    /// The trace's time 0 is `start_ns` (host time). Each sample arrives `delay_ns` (>= 0, the
    /// tracker's modelled delay) after it was taken, plus the delay that the trace recorded, and
    /// not before its predecessor. Head poses whose time goes back are left out of the track.
    /// `speed` (> 0): how many times faster than recorded it is played, the modelled delay apart.
    TraceSource(gaze::GazeTrace trace, std::int64_t start_ns, std::int64_t delay_ns,
                double speed = 1.0);

    void poll(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples) override;
    /// The head poses at the samples' times; null if the trace has none.
    [[nodiscard]] const gaze::HeadMotion* head_track() const override;
    [[nodiscard]] const gaze::GazeTrace* trace() const override { return &trace_; }
    [[nodiscard]] bool finished() const override { return next_ == trace_.samples.size(); }
    [[nodiscard]] std::string description() const override;

  private:
    gaze::GazeTrace trace_;  // its times are host times here
    gaze::HeadTrack head_track_;
    std::size_t next_ = 0;
};

}  // namespace gazeloop::drivers
