#pragma once

#include "runtime/gaze/gaze_sample.h"
#include "runtime/gaze/sample_range.h"

namespace gazeloop::gaze {

/// Reports per second of a tracker, Hz, by the times of its samples: one over the mean interval,
/// which a clock's steps and jitter leave alone. Left out are gaps, and unknown times or such that
/// go back; where sequence numbers mostly count by one, an interval over lost ones counts for as
/// many. A gap is longer than 8 median intervals, or than 1.75 where most hardly vary and twice the
/// usual one is a loss. 0: no interval.
[[nodiscard]] double sample_rate_hz(const SampleRange& samples);

}  // namespace gazeloop::gaze
