#include "runtime/foveation/eye/geisler_perry_acuity.h"

#include <cmath>

namespace gazeloop::foveation {

double GeislerPerryAcuity::cutoff_cpd(double eccentricity_deg, double /*nasal*/) const {
    return kHalfResolutionDeg * -std::log(kFovealThreshold) /
           (kDecay * (eccentricity_deg + kHalfResolutionDeg));
}

}  // namespace gazeloop::foveation
