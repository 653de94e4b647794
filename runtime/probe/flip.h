#pragma once

#include <cstdint>

#include "runtime/gaze/fovea_point.h"
#include "runtime/time/stamp.h"

namespace gazeloop::probe {

/// A flip of the patch, in the frame that showed it first.
struct Flip {
    bool lost = false;  ///< the patch went white, because the eye was lost; else black again
    /// Why it counts as lost; None for an eye that was found.
    gaze::LossReason reason = gaze::LossReason::None;
    std::uint64_t frame = 0;
    std::uint64_t sample = 0;  ///< sequence number of the first sample that said so
    time::Stamp sampled;       ///< of that sample; unknown where no sample said so (silence)
    time::Stamp arrived;
    time::Stamp latched;  ///< when the frame read the gaze for the last time
    time::Stamp display;  ///< announced middle of its emission
    time::Stamp shown;    ///< the same, or later where the GPU was late; unknown until it is known
    std::int64_t period_ns = 0;
};

}  // namespace gazeloop::probe
