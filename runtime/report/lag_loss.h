#pragma once

#include <string>

#include "runtime/report/lag_facts.h"

namespace gazeloop::report {

/// Of the frames with a gaze source, so many percent without fresh gaze are no blinks: people blink
/// some 15 times a minute, and no more than 6 % of the time.
inline constexpr double kOftenLost_percent = 10.0;

/// Whether the fovea had no fresh gaze so often that any lag matters less. False where it never had
/// any: that is another matter.
[[nodiscard]] bool often_lost(const LagFacts& facts);

/// "In 31.2 % of the frames the fovea has no fresh gaze, most often because ...". Precondition:
/// often_lost.
[[nodiscard]] std::string loss_sentence(const LagFacts& facts);

/// The one thing to try against the commonest cause. Precondition: often_lost.
[[nodiscard]] std::string loss_remedy(const LagFacts& facts);

/// "20 because neither eye was seen, 3 because of a blink": frames by cause where it is known, else
/// by reason.
[[nodiscard]] std::string losses_by_cause(const latency::GazeUseCounts& use);

}  // namespace gazeloop::report
