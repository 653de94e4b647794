#pragma once

#include "runtime/error.h"

namespace gazeloop::gaze {

/// The error that 95 % of fixations stay under, for a tracker whose median error is `median_deg`.
/// From the Vive Pro Eye at 90 Hz, with targets 0 to 3, 8 to 12 and 17 to 25 deg off the middle.
/// Its medians were .43, .61 and .89 deg, and its 95 % errors 1.13, 1.56 and 2.30 deg: 2.56 to 2.63
/// times as much.
[[nodiscard]] constexpr double bias95_deg(double median_deg) { return 2.6 * median_deg; }

/// How uncertain it is where the eye looks when the picture is seen.
struct GazeUncertainty {
    double bias95_deg = 0.0;            ///< the tracker's systematic error
    double z = 1.96;                    ///< standard deviations to allow for: 95 %
    double sample_sd_deg = 0.0;         ///< the tracker's noise
    double filter_sd_deg = 0.0;         ///< what filtering and prediction add
    double pursuit_deg_s = 0.0;         ///< speed of the eye following something
    double latency_s = 0.0;             ///< eye to photon, less what prediction covers
    double head_rate_deg_s = 0.0;       ///< 0 where the head pose is known
    double gaze_age_s = 0.0;            ///< of the sample
    double saccade_residual_deg = 0.0;  ///< the part of a saccade still to come
};

/// By how many degrees the fovea must widen:
///     D = bias95 + z sqrt(s_sample^2 + s_filter^2) + v_pursuit T + head rate x age + S.
/// Widening does not make a saccade harmless. One of 20 degrees takes D past 10 degrees for most of
/// its duration; suppression, prediction or blanking is cheaper then. Errors (Usage): a term
/// negative, infinite or not a number.
Expected<double> widening_deg(const GazeUncertainty& uncertainty);

/// The greatest widening that is accepted: beyond it, nothing is known of the gaze.
inline constexpr double kMaxWideningDeg = 180.0;

}  // namespace gazeloop::gaze
