#pragma once

#include <cstdint>
#include <optional>

#include "runtime/frame/frame_gaze.h"
#include "runtime/latency/commonest_period.h"
#include "runtime/latency/gaze_errors.h"
#include "runtime/latency/pending_frames.h"
#include "runtime/latency/sample_counter.h"

namespace gazeloop::session {

/// Keeps the books of a recording's gaze while its records are written, so that who wants no more
/// than these need not read its samples: they are ten times as many as its frames.
class GazeLedger {
  public:
    void add(const gaze::GazeSample& sample);
    void move_origin(const gaze::Pose& new_in_old) { errors_.move_origin(new_in_old); }
    void add(const frame::FrameRecord& record);
    void add(const frame::FrameGpuRecord& record);
    /// Nothing follows.
    void finish();

    /// Of the samples so far.
    [[nodiscard]] const frame::GazeCounts& counts() const { return samples_.counts(); }
    /// See latency::GazeErrors; to be called after each add() of a frame.
    template <typename Take>
    void take_decided(const Take& take) {
        errors_.take_decided(take);
    }

  private:
    void set_shown(const latency::FinishedFrame& finished);

    latency::SampleCounter samples_;
    latency::CommonestPeriod periods_;
    latency::PendingFrames pending_;
    latency::GazeErrors errors_;
};

}  // namespace gazeloop::session
