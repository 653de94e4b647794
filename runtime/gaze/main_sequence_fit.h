#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace gazeloop::gaze {

/// A saccade's point on the main sequence.
struct SaccadePoint {
    double amplitude_deg = 0.0;
    double peak_deg_per_s = 0.0;
    double duration_ms = 0.0;
};

/// The main sequence of one recording: peak velocity `saturation (1 - exp(-A / bend))` and duration
/// `slope A + intercept` of saccades of A degrees, each by least squares.
struct MainSequenceFit {
    std::size_t saccades = 0;
    double saturation_deg_per_s = 0.0;
    double bend_deg = 0.0;
    double peak_rmse_deg_per_s = 0.0;
    double ms_per_deg = 0.0;
    double intercept_ms = 0.0;
    double duration_rmse_ms = 0.0;
    /// Whether the peak velocities show where they saturate; else they are as well fitted by a
    /// straight line, and saturation and bend are one number: their ratio, the slope at 0.
    bool saturates = false;
    /// Median of the peak velocities over those of main_sequence.h.
    double peak_over_published = 0.0;
};

/// Needs kFewestForMainSequence finite points with amplitude, peak and duration above 0, and two
/// different amplitudes; else none. Others are left out.
[[nodiscard]] std::optional<MainSequenceFit> fit_main_sequence(
    std::span<const SaccadePoint> saccades);

inline constexpr std::size_t kFewestForMainSequence = 10;
inline constexpr double kLeastBend_deg = 1.0;   ///< of the fit; published: 6.5
inline constexpr double kMostBend_deg = 100.0;  ///< at it, the peak velocities do not saturate

}  // namespace gazeloop::gaze
