#include "runtime/gaze/gaze_uncertainty.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace gazeloop::gaze {

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

}  // namespace gazeloop::gaze
