#include "runtime/foveation/eye/fovea_widening.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace gazeloop::foveation {

Expected<double> widening_deg(const GazeUncertainty& uncertainty) {
    const GazeUncertainty& u = uncertainty;
    const std::array<std::pair<const char*, double>, 9> terms{
        {{"bias95_deg", u.bias95_deg},
         {"z", u.z},
         {"sample_sd_deg", u.sample_sd_deg},
         {"filter_sd_deg", u.filter_sd_deg},
         {"pursuit_deg_s", u.pursuit_deg_s},
         {"latency_s", u.latency_s},
         {"head_rate_deg_s", u.head_rate_deg_s},
         {"gaze_age_s", u.gaze_age_s},
         {"saccade_residual_deg", u.saccade_residual_deg}}};
    for (const auto& [what, value] : terms) {
        if (!(value >= 0.0 && std::isfinite(value))) {
            return std::unexpected(
                Error{ErrorKind::Usage,
                      fmt::format("gaze uncertainty: {} = {}: must be 0 or more and finite", what,
                                  value)});
        }
    }
    const double widening = u.bias95_deg + u.z * std::hypot(u.sample_sd_deg, u.filter_sd_deg) +
                            u.pursuit_deg_s * u.latency_s + u.head_rate_deg_s * u.gaze_age_s +
                            u.saccade_residual_deg;
    return std::min(widening, kMaxWideningDeg);
}

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
