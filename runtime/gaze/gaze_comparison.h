#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "runtime/error.h"
#include "runtime/gaze/gaze_sample.h"
#include "runtime/gaze/sample_range.h"

namespace gazeloop::gaze {

/// How a recording says what another one of the same eyes says: other = gain x one + offset.
struct AxisAgreement {
    double gain = 0.0;
    double offset_deg = 0.0;
    double residual_deg = 0.0;  ///< root mean square of what gain and offset leave
    double correlation = 0.0;   ///< of the two, after the lag
};

/// Two recordings of the same eyes at the same time.
struct GazeComparison {
    /// Velocities of the same eyes correlate more than this. Those of eight pairs of recordings of
    /// different people, two of them of the same video, do by .06 to .26 at the best of all lags.
    static constexpr double kLeastCorrelation = 0.5;

    /// How much later the other recording shows the same movement, each counted from its own first
    /// sample. Where the velocities of both correlate most.
    double lag_ms = 0.0;
    /// 95 % interval of the lag, by resampling blocks of kComparedBlock_s (percentile bootstrap);
    /// none: too few blocks.
    std::optional<std::array<double, 2>> lag_interval_ms{};
    double correlation = 0.0;   ///< of the velocities, at that lag
    AxisAgreement azimuth{};    ///< positive right
    AxisAgreement elevation{};  ///< positive up
    double overlap_s = 0.0;     ///< with gaze in both, after the lag
    double step_ms = 0.0;       ///< of the grid on which both were compared
    /// Correlation of the velocities at each lag from -kComparedMostLag_s on, a step apart; NaN
    /// where they have less than kComparedLeast_s in common.
    std::vector<double> correlation_at{};
    [[nodiscard]] double lag_at_ms(std::size_t i) const {
        const std::size_t middle = correlation_at.size() / 2;
        return (static_cast<double>(i) - static_cast<double>(middle)) * step_ms;
    }

    /// Whether they may be of other eyes, or of another time.
    [[nodiscard]] bool doubtful() const { return !(correlation > kLeastCorrelation); }
};

/// Compares them by the mean direction of the valid eyes, in the head. Recordings are sampled on
/// one grid, as fine as the finer one's samples (2 to 20 ms), between neighbours at most
/// kComparedBridge_ms apart, and shifted by up to kComparedMostLag_s against each other. Of long
/// recordings the first kComparedMost_s are compared.
///
/// Errors (BadInput): less than kComparedLeast_s of gaze in both at any lag; gaze that does not
/// move in one of them.
[[nodiscard]] Expected<GazeComparison> compare_gaze(const SampleRange& one,
                                                    const SampleRange& other);

inline constexpr double kComparedBridge_ms = 60.0;
inline constexpr double kComparedMostLag_s = 2.0;
inline constexpr double kComparedMost_s = 300.0;
inline constexpr double kComparedLeast_s = 2.0;
inline constexpr double kComparedBlock_s = 2.0;

}  // namespace gazeloop::gaze
