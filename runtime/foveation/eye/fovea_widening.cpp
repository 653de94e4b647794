#include "runtime/foveation/eye/fovea_widening.h"

#include <algorithm>

namespace gazeloop::foveation {

double WidenedAcuity::cutoff_cpd(double eccentricity_deg, double nasal) const {
    return model_.cutoff_cpd(std::max(0.0, eccentricity_deg - widening_deg_), nasal);
}

double display_limit_deg(const AcuityModel& model, double display_per_deg, double nasal) {
    const auto display_limits = [&](double eccentricity_deg) {
        return required_per_deg(model, eccentricity_deg, nasal) >= display_per_deg;
    };
    double low = 0.0;
    double high = 180.0;
    if (!display_limits(low)) {
        return 0.0;
    }
    if (display_limits(high)) {
        return high;
    }
    while (high - low > 1e-9) {
        const double middle = 0.5 * (low + high);
        (display_limits(middle) ? low : high) = middle;
    }
    return low;
}

}  // namespace gazeloop::foveation
