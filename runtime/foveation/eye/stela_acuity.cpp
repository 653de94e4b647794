#include "runtime/foveation/eye/stela_acuity.h"

#include <cmath>

namespace gazeloop::foveation {
namespace {

/// The table's frequencies: 2^-6 to 2^8 cycles per degree, kStepsPerOctave to the octave. Linear
/// interpolation between them moves a cut-off by less than 1e-5 of itself.
constexpr int kStepsPerOctave = 128;
constexpr int kLowestOctave = -6;
constexpr std::size_t kEntries = 14 * std::size_t{kStepsPerOctave} + 1;

double frequency_cpd(double entry) { return std::exp2(kLowestOctave + entry / kStepsPerOctave); }

}  // namespace

Expected<std::unique_ptr<StelaAcuity>> StelaAcuity::create(const StelaConditions& conditions,
                                                           StelaField field) {
    if (const auto checked = check_conditions(conditions); !checked) {
        return std::unexpected(checked.error());
    }
    return std::unique_ptr<StelaAcuity>(new StelaAcuity(conditions, field));
}

StelaAcuity::StelaAcuity(const StelaConditions& conditions, StelaField field) : field_(field) {
    log10_sensitivity_.reserve(kEntries);
    for (std::size_t entry = 0; entry < kEntries; ++entry) {
        log10_sensitivity_.push_back(std::log10(
            stela_foveal_sensitivity(frequency_cpd(static_cast<double>(entry)), conditions)));
    }
}

double StelaAcuity::reach_deg(std::size_t entry, const StelaDecay& decay) const {
    return log10_sensitivity_[entry] /
           (decay.per_deg + decay.per_deg_cpd * frequency_cpd(static_cast<double>(entry)));
}

double StelaAcuity::cutoff_cpd(double eccentricity_deg, double nasal) const {
    const StelaDecay decay = stela_decay(field_ == StelaField::Directional ? nasal : 0.0);
    // A grating's reach rises with frequency to one peak, then falls, because it is a concave
    // function of frequency over a linear one. Find the peak, then the crossing beyond it.
    std::size_t low = 0;
    std::size_t high = kEntries - 1;
    while (low < high) {
        const std::size_t middle = low + (high - low) / 2;
        if (reach_deg(middle, decay) < reach_deg(middle + 1, decay)) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    if (reach_deg(low, decay) < eccentricity_deg) {
        return 0.0;
    }
    high = kEntries - 1;
    if (reach_deg(high, decay) >= eccentricity_deg) {
        return frequency_cpd(static_cast<double>(high));
    }
    while (high - low > 1) {
        const std::size_t middle = low + (high - low) / 2;
        (reach_deg(middle, decay) >= eccentricity_deg ? low : high) = middle;
    }
    const auto log10_at = [&](std::size_t entry) {
        return log10_sensitivity_[entry] -
               (decay.per_deg + decay.per_deg_cpd * frequency_cpd(static_cast<double>(entry))) *
                   eccentricity_deg;
    };
    const double inside = log10_at(low);
    const double share = inside / (inside - log10_at(high));
    return frequency_cpd(static_cast<double>(low) + share);
}

}  // namespace gazeloop::foveation
