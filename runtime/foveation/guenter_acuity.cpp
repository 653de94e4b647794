#include "runtime/foveation/guenter_acuity.h"

#include <fmt/core.h>

namespace gazeloop::foveation {

Expected<void> check_mar_line(const MarLine& line) {
    // Written so that NaN is refused too.
    if (!(line.slope >= kMinMarSlope && line.slope <= kMaxMarSlope)) {
        return std::unexpected(
            Error{ExitCode::Usage, fmt::format("MAR slope m = {}: must lie in [{}, {}]", line.slope,
                                               kMinMarSlope, kMaxMarSlope)});
    }
    if (!(line.omega0_deg >= kMinOmega0Deg && line.omega0_deg <= kMaxOmega0Deg)) {
        return std::unexpected(
            Error{ExitCode::Usage, fmt::format("MAR at the fovea, omega0 = {} degrees per cycle: "
                                               "must lie in [{}, {}]",
                                               line.omega0_deg, kMinOmega0Deg, kMaxOmega0Deg)});
    }
    return {};
}

Expected<std::unique_ptr<GuenterAcuity>> GuenterAcuity::create(const MarLine& line) {
    if (const auto checked = check_mar_line(line); !checked) {
        return std::unexpected(checked.error());
    }
    return std::unique_ptr<GuenterAcuity>(new GuenterAcuity(line));
}

double GuenterAcuity::cutoff_cpd(double eccentricity_deg, double /*nasal*/) const {
    return 1.0 / line_.omega_deg(eccentricity_deg);
}

}  // namespace gazeloop::foveation
