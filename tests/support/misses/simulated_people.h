#pragma once

#include <cstdint>

#include "sim/gaze_simulation.h"

namespace gazeloop::tests {

/// Persons to choose figures on, and others to report them on: no number is in both.
inline constexpr std::uint64_t kFirstChosenOn = 1;
inline constexpr std::uint64_t kFirstOther = 3001;

/// Somebody out of many, with this tracker: people differ in how long they look, how far apart
/// their targets lie, how they drift, blink and pursue, and how far away they look. The spreads are
/// assumed; the medians are those of EyeTerms. The same number is the same person.
[[nodiscard]] sim::GazeSimulation simulated_person(std::uint64_t number,
                                                   const sim::TrackerTerms& tracker);

}  // namespace gazeloop::tests
