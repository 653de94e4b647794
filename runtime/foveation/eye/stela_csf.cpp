#include "runtime/foveation/eye/stela_csf.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace gazeloop::foveation {
namespace {

Expected<void> check(const char* what, double value, double least, double greatest) {
    if (!(value >= least && value <= greatest)) {  // true for NaN
        return std::unexpected(Error{
            ErrorKind::Usage,
            fmt::format("stelaCSF: {} = {}: must lie in [{}, {}]", what, value, least, greatest)});
    }
    return {};
}

/// One of the two channels' response to space: a log-parabola, flattened below its peak, times the
/// summation over the grating's area.
struct Channel {
    double peak;
    double peak_cpd;
    double bandwidth;
    double truncation;

    [[nodiscard]] double operator()(double frequency_cpd, double area_deg2) const {
        const double octaves = std::log10(frequency_cpd / peak_cpd);
        double band = std::pow(10.0, -octaves * octaves / std::exp2(bandwidth));
        if (frequency_cpd < peak_cpd) {
            band = std::max(band, 1.0 - truncation);
        }
        const double ratio = frequency_cpd / 0.65;
        const double critical_area = 270.0 / (1.0 + ratio * ratio);
        return peak * band * std::sqrt(critical_area / (1.0 + critical_area / area_deg2)) *
               frequency_cpd;
    }
};

Channel sustained(double luminance) {
    // 1 - (1 + x)^-y for x of 1e-7 and y of 1e10: by logarithms, or nothing is left of it.
    const double threshold = -std::expm1(-8.50217e9 * std::log1p(7.54866e-7 / luminance));
    return {.peak = 44.4763 * std::pow(1.0 + 0.713964 / luminance, -0.277857) * threshold,
            .peak_cpd = 1.55909 * std::pow(1.0 + 103.604 / luminance, -0.251815),
            .bandwidth = 0.177674,
            .truncation = 1.74265e-102};
}

Channel transient(double luminance) {
    return {.peak = 211.504 * std::pow(luminance, 0.411266),
            .peak_cpd = 0.00115423,
            .bandwidth = 2.52628,
            .truncation = 0.000273289};
}

}  // namespace

Expected<void> check_conditions(const StelaConditions& conditions) {
    using C = StelaConditions;
    if (auto checked = check("luminance, cd/m2,", conditions.luminance_cd_m2, C::kMinLuminance,
                             C::kMaxLuminance);
        !checked) {
        return checked;
    }
    if (auto checked =
            check("temporal frequency, Hz,", conditions.temporal_hz, 0.0, C::kMaxTemporalHz);
        !checked) {
        return checked;
    }
    return check("area, square degrees,", conditions.area_deg2, C::kMinAreaDeg2, C::kMaxAreaDeg2);
}

StelaDecay stela_decay(double nasal) {
    constexpr StelaDecay kTemporalSide{0.0277526, 0.0175072};
    constexpr StelaDecay kNasalSide{0.0275591, 0.00987064};
    return {std::lerp(kTemporalSide.per_deg, kNasalSide.per_deg, nasal),
            std::lerp(kTemporalSide.per_deg_cpd, kNasalSide.per_deg_cpd, nasal)};
}

double stela_sustained_sensitivity(double frequency_cpd, const StelaConditions& conditions) {
    return sustained(conditions.luminance_cd_m2)(frequency_cpd, conditions.area_deg2);
}

double stela_transient_sensitivity(double frequency_cpd, const StelaConditions& conditions) {
    return transient(conditions.luminance_cd_m2)(frequency_cpd, conditions.area_deg2);
}

double stela_sustained_response(double temporal_hz) {
    return std::exp(-std::pow(temporal_hz, 1.3314) / 15.8409);
}

double stela_transient_response(double temporal_hz) {
    const double off_peak = std::pow(temporal_hz, 0.1898) - std::pow(5.0, 0.1898);
    return std::exp(-off_peak * off_peak / 0.156257);
}

double stela_foveal_sensitivity(double frequency_cpd, const StelaConditions& conditions) {
    return stela_sustained_response(conditions.temporal_hz) *
               stela_sustained_sensitivity(frequency_cpd, conditions) +
           stela_transient_response(conditions.temporal_hz) *
               stela_transient_sensitivity(frequency_cpd, conditions);
}

}  // namespace gazeloop::foveation
