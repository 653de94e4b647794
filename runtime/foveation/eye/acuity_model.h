#pragma once

#include <string_view>

#include "runtime/gaze/eye.h"

namespace gazeloop::foveation {

/// What the eye can see at an eccentricity. Models differ by what they mean by "see". Guenter's
/// line is the sampling that viewers accept; stelaCSF is what they can just detect, which takes two
/// to four times as many samples. Report against more than one.
class AcuityModel {
  public:
    AcuityModel() = default;
    AcuityModel(const AcuityModel&) = delete;
    AcuityModel& operator=(const AcuityModel&) = delete;
    virtual ~AcuityModel() = default;

    [[nodiscard]] virtual std::string_view name() const = 0;

    /// The highest spatial frequency that matters, in cycles per degree; 0 where no grating can be
    /// seen at all. It never rises with eccentricity.
    ///
    /// `eccentricity_deg` in [0, 180]. `nasal` in [0, 1]: how far the direction lies towards the
    /// nose (nasal_share); models that know no direction ignore it.
    [[nodiscard]] virtual double cutoff_cpd(double eccentricity_deg, double nasal) const = 0;
};

/// Samples per degree, each way, that represent the model's cut-off (two per cycle: Nyquist).
[[nodiscard]] inline double required_per_deg(const AcuityModel& model, double eccentricity_deg,
                                             double nasal) {
    return 2.0 * model.cutoff_cpd(eccentricity_deg, nasal);
}

/// How far a direction in the visual field lies towards the nose: 1 on the nasal meridian. It falls
/// linearly with the angle from that meridian, to 0 at a right angle and beyond (Mantiuk et al.
/// 2022). `direction_rad`: 0 to the right, counter-clockwise as seen by the viewer, any number of
/// turns.
[[nodiscard]] double nasal_share(gaze::Eye eye, double direction_rad);

}  // namespace gazeloop::foveation
