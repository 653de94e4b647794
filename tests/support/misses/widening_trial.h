#pragma once

#include <cstdint>
#include <vector>

#include "tests/support/misses/shown_gaze.h"

namespace gazeloop::tests {

/// How foveae follow people, by what their widening follows.
enum class WideningRule {
    Held,        ///< no widening, no prediction
    Predicted,   ///< no widening
    ByAge,       ///< with prediction
    ByEvents,    ///< with prediction
    Suppressed,  ///< by events, but not in frames shown in flight
};

/// A tracker as config/trackers/generic.toml has it: 120 Hz, 15 ms late, some .4 deg off.
inline constexpr sim::TrackerTerms kGenericTracker{.rate_hz = 120.0,
                                                   .delay_ms = 15.0,
                                                   .jitter_ms = 0.5,
                                                   .bias_deg = 0.4,
                                                   .bias_growth_percent = 5.0,
                                                   .noise_deg = 0.14,
                                                   .noise_growth_percent = 3.0};

/// A square view of so many pixels and degrees across, for either eye.
[[nodiscard]] gaze::EyeView square_view(std::uint32_t side_px, double across_deg);

/// Both eyes of so many persons (simulated_people.h), from `first` on, 30 s of each at 90 Hz.
[[nodiscard]] std::vector<ShownGaze> widening_trial(WideningRule rule, std::uint64_t first,
                                                    std::uint64_t persons,
                                                    const sim::TrackerTerms& tracker);

}  // namespace gazeloop::tests
