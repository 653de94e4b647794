#include "runtime/foveation/eye/guenter_acuity.h"

namespace gazeloop::foveation {

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
