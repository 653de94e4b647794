#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "tests/support/coded/coded_recordings.h"

namespace gazeloop::tests {

/// What the eyes do at the time that is predicted, where both coders say the same.
enum class TargetClass {
    Fixation,
    Oscillation,
    Pursuit,
    Saccade,  ///< that had been going on for 4 ms or more when it was predicted
    Onset,    ///< a saccade that began later than that: nobody could know
};
inline constexpr std::array<const char*, 5> kTargetClassNames{"fixation", "oscillation", "pursuit",
                                                              "saccade", "onset"};
inline constexpr std::array<int, 5> kHorizons_ms{5, 10, 20, 40, 60};
enum class Predictor { HoldLast, Linear, OneEuro, Ours };
inline constexpr std::array<const char*, 4> kPredictorNames{"hold-last", "linear", "one-euro",
                                                            "ours"};

/// Errors in degrees, by predictor.
using Errors = std::array<std::vector<double>, kPredictorNames.size()>;
/// Of a person, by class and horizon.
using PersonErrors = std::array<std::array<Errors, kHorizons_ms.size()>, kTargetClassNames.size()>;

/// From every sample to every horizon, but where a blink lies between or the coders differ.
[[nodiscard]] std::map<std::string, PersonErrors> prediction_errors(
    const std::vector<const CodedRecording*>& recordings);

/// The value that so many percent are not above (nearest rank). Precondition: not empty.
[[nodiscard]] double percentile(std::vector<double> values, double percent);

/// A person's percentile counts with this many samples or more.
inline constexpr std::size_t kFewestErrors = 20;

/// The 95th percentile of a predictor over that of holding, of each person that has enough errors
/// of this class and horizon.
[[nodiscard]] std::vector<double> ratios_to_hold(const std::map<std::string, PersonErrors>& errors,
                                                 TargetClass target, std::size_t horizon,
                                                 Predictor predictor);

}  // namespace gazeloop::tests
