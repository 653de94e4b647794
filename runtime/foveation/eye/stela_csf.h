#pragma once

#include <numbers>

#include "runtime/error.h"

namespace gazeloop::foveation {

/// The conditions under which a grating is seen.
struct StelaConditions {
    static constexpr double kMinLuminance = 1e-3;
    static constexpr double kMaxLuminance = 1e4;
    static constexpr double kMaxTemporalHz = 240.0;
    static constexpr double kMinAreaDeg2 = 1e-4;
    static constexpr double kMaxAreaDeg2 = 1e4;

    double luminance_cd_m2 = 100.0;       ///< [kMinLuminance, kMaxLuminance]
    double temporal_hz = 0.0;             ///< [0, kMaxTemporalHz]
    double area_deg2 = std::numbers::pi;  ///< of the grating, [kMinAreaDeg2, kMaxAreaDeg2]
};

/// Errors (Usage): a condition out of range or not a number.
Expected<void> check_conditions(const StelaConditions& conditions);

/// How sensitivity falls with eccentricity e at f cycles per degree: by 10^-((k + k_f f) e).
struct StelaDecay {
    double per_deg = 0.0;      ///< k
    double per_deg_cpd = 0.0;  ///< k_f
};

/// The decay in a direction that lies `nasal` (nasal_share, in [0, 1]) towards the nose.
[[nodiscard]] StelaDecay stela_decay(double nasal);

/// Contrast sensitivity (1 / threshold contrast) at the fovea for an achromatic grating, by
/// stelaCSF with its published parameters. Fitted for .0625 to 64 cycles per degree; outside that
/// range the formula is extrapolated. Preconditions: frequency_cpd > 0, conditions that
/// check_conditions accepts.
///
/// Source: Mantiuk, Ashraf and Chapiro 2022, "stelaCSF: a unified model of contrast sensitivity as
/// the function of spatio-temporal frequency, eccentricity, luminance and area".
[[nodiscard]] double stela_foveal_sensitivity(double frequency_cpd,
                                              const StelaConditions& conditions);

/// Its two parts by space alone, whatever conditions.temporal_hz: each is weighed by its response
/// to time, and the sum is the above.
[[nodiscard]] double stela_sustained_sensitivity(double frequency_cpd,
                                                 const StelaConditions& conditions);
[[nodiscard]] double stela_transient_sensitivity(double frequency_cpd,
                                                 const StelaConditions& conditions);
/// Those responses, in [0, 1]: the sustained part is 1 at 0 Hz, the transient one at 5 Hz.
[[nodiscard]] double stela_sustained_response(double temporal_hz);
[[nodiscard]] double stela_transient_response(double temporal_hz);

}  // namespace gazeloop::foveation
