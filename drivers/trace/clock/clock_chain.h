#pragma once

#include <cstddef>
#include <functional>

#include "runtime/memory/long_vector.h"

namespace gazeloop::drivers {

/// Of readings, however quick they come.
inline constexpr std::size_t kLongestBurst = 16;

/// What two readings of a clock, by their positions, are to each other.
struct ClockSteps {
    /// Whether neighbours belong together without a doubt, as most do.
    std::function<bool(std::size_t before, std::size_t after)> joins;
    /// How little is to be said for the one following the other, as a number of readings that may
    /// be left out instead. 0: nothing against it.
    std::function<double(std::size_t before, std::size_t after)> doubt;
    /// So many readings may be left out in a row, [kLongestBurst, 3 * kLongestBurst].
    std::size_t longest_burst = kLongestBurst;
};

/// With less doubt than this two readings agree.
inline constexpr double kDisagree = 1.0;
/// The doubt about a step that the clock itself cannot have made: more than the longest burst, so
/// that a burst is left out where this saves one such step.
inline constexpr double kImpossibleStep = 20.0;

/// Which of `count` readings are those of one clock, however often it was set: the choice with the
/// least sum of doubts and readings left out; of longer bursts than 16 each reading counts for as
/// much less. What is left out are bursts of at most an eighth of the readings and at most
/// `longest_burst`, so that what lasts is never left out, and only where the readings before and
/// after then agree. At the ends a burst is left out if there are 16 readings, and more
/// in a row next to it than it has itself. O(count).
[[nodiscard]] memory::LongVector<bool> readings_in_step(std::size_t count, const ClockSteps& steps);

}  // namespace gazeloop::drivers
