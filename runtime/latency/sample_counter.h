#pragma once

#include <cstdint>

#include "runtime/gaze/gaze_sample.h"

namespace gazeloop::latency {

/// What became of a tracker's samples on the way to the host.
struct GazeCounts {
    std::uint64_t received = 0;
    std::uint64_t invalid = 0;  ///< the tracker vouches for neither eye
    std::uint64_t lost = 0;     ///< by gaps in the sequence numbers
    /// Repeated, overtaken by a higher sequence number, or sampled before its predecessor.
    std::uint64_t out_of_order = 0;

    friend bool operator==(const GazeCounts&, const GazeCounts&) = default;
};

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
