#include "runtime/gaze/main_sequence.h"

#include <cmath>

namespace gazeloop::gaze {
namespace {

// Peak over mean velocity of the two profiles that are mixed so that both the duration and the peak
// velocity come out right: velocities as (t (1 - t))^2, minimum jerk, and as its cube. The main
// sequence asks for 1.46 (towards 0 deg) to 1.94 (12 deg) and 1.57 (180 deg); the mix keeps its
// peak in the middle, and moves forward only, from 1.458 (a weight of -4/3) upwards.
constexpr double kMinimumJerkPeak = 1.875;
constexpr double kSharperPeak = 2.1875;

}  // namespace

MainSequence main_sequence(double amplitude_deg) {
    return {.duration_s = (2.54 * amplitude_deg + 15.9) * 1e-3,
            .peak_deg_per_s = -596.0 * std::expm1(-amplitude_deg / 6.47)};
}

SaccadeCourse::SaccadeCourse(double amplitude_deg, double vigour, double lean) : lean_(lean) {
    const MainSequence normal = main_sequence(amplitude_deg);
    const double peak_over_mean = normal.peak_deg_per_s * normal.duration_s / amplitude_deg;
    sharpness_ = (peak_over_mean - kMinimumJerkPeak) / (kSharperPeak - kMinimumJerkPeak);
    duration_s_ = normal.duration_s / vigour;
}

double SaccadeCourse::progress(double elapsed_s) const {
    if (elapsed_s >= duration_s_) {
        return 1.0;
    }
    const double share = elapsed_s / duration_s_;
    const double t = share + lean_ * share * (1.0 - share);
    const double minimum_jerk = t * t * t * (10.0 + t * (-15.0 + t * 6.0));
    const double sharper = t * t * t * t * (35.0 + t * (-84.0 + t * (70.0 - t * 20.0)));
    return minimum_jerk + sharpness_ * (sharper - minimum_jerk);
}

}  // namespace gazeloop::gaze
