#pragma once

#include <cstdint>

#include "runtime/frame/frame_gaze.h"
#include "runtime/gaze/gaze_sample.h"

namespace gazeloop::latency {

using frame::GazeCounts;

/// Counts samples in the order of arrival.
class SampleCounter {
  public:
    void add(const gaze::GazeSample& sample);
    [[nodiscard]] const GazeCounts& counts() const { return counts_; }

  private:
    GazeCounts counts_;
    std::uint64_t highest_sequence_ = 0;
    time::Stamp last_sampled_;  ///< not the greatest, so that a clock that is set back counts once
};

}  // namespace gazeloop::latency
