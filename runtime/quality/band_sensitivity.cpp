#include "runtime/quality/band_sensitivity.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gazeloop::quality {
namespace {

/// castleCSF's sensitivity to colour: a log-parabola that is flat below its peak, times the
/// summation over the grating's area; the peak rises with luminance.
struct ColourSensitivity {
    double peak;
    double peak_luminance;
    double peak_exponent;
    double peak_cpd;
    double bandwidth;
    double critical_area;
    double critical_cpd;

    [[nodiscard]] double operator()(double frequency_cpd, double luminance_cd_m2) const {
        const double most = peak * std::pow(1.0 + peak_luminance / luminance_cd_m2, -peak_exponent);
        const double decades = std::log10(std::max(frequency_cpd, peak_cpd) / peak_cpd);
        const double band = std::pow(10.0, -decades * decades / std::exp2(bandwidth));
        const double ratio = frequency_cpd / critical_cpd;
        const double area = critical_area / (1.0 + ratio * ratio);
        return most * band * std::sqrt(area / (1.0 + area / std::numbers::pi)) * frequency_cpd;
    }
};

constexpr ColourSensitivity kRedGreenSensitivity{681.434, 38.0038, 0.480386, 0.0178364,
                                                 2.42104, 2816.44, 0.0711058};
constexpr ColourSensitivity kYellowVioletSensitivity{166.683, 62.8974,    0.41193,    0.00425753,
                                                     2.68197, 2.82789e+7, 0.000635093};

}  // namespace

double foveal_sensitivity(Mechanism mechanism, double frequency_cpd, double luminance_cd_m2) {
    const foveation::StelaConditions conditions{.luminance_cd_m2 = luminance_cd_m2};
    switch (mechanism) {
        case Mechanism::Sustained:
            return foveation::stela_sustained_sensitivity(frequency_cpd, conditions);
        case Mechanism::Transient:
            return foveation::stela_transient_sensitivity(frequency_cpd, conditions);
        case Mechanism::RedGreen:
            return kRedGreenSensitivity(frequency_cpd, luminance_cd_m2);
        case Mechanism::YellowViolet:
            return kYellowVioletSensitivity(frequency_cpd, luminance_cd_m2);
    }
    return 0.0;
}

foveation::StelaDecay sensitivity_decay(Mechanism mechanism, double nasal) {
    switch (mechanism) {
        case Mechanism::RedGreen:
            return {0.0591402, 0.0};
        case Mechanism::YellowViolet:
            return {0.00356865, 0.00806631};
        case Mechanism::Sustained:
        case Mechanism::Transient:
            break;
    }
    return foveation::stela_decay(nasal);
}

SensitivityTable::SensitivityTable(Mechanism mechanism) {
    values_.reserve(kFrequencies * kLuminances);
    for (std::size_t f = 0; f < kFrequencies; ++f) {
        for (std::size_t l = 0; l < kLuminances; ++l) {
            const double cpd = std::exp2(static_cast<double>(kLeastLog2Cpd) +
                                         static_cast<double>(f) / static_cast<double>(kPerOctave));
            const double luminance =
                std::exp2(static_cast<double>(kLeastLog2Luminance) +
                          static_cast<double>(l) / static_cast<double>(kPerDoubling));
            values_.push_back(
                static_cast<float>(std::log2(foveal_sensitivity(mechanism, cpd, luminance))));
        }
    }
}

}  // namespace gazeloop::quality
