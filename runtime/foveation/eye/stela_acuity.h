#pragma once

#include <memory>
#include <vector>

#include "runtime/error.h"
#include "runtime/foveation/eye/acuity_model.h"
#include "runtime/foveation/eye/stela_csf.h"

namespace gazeloop::foveation {

/// Which directions of the visual field stelaCSF tells apart.
enum class StelaField {
    TemporalEverywhere,  ///< the side away from the nose, taken for every direction
    Directional,         ///< as published: sharper towards the nose
};

/// The cut-off by stelaCSF: the highest frequency at which a grating of full contrast is seen
/// (sensitivity 1). It is 0 where no frequency reaches sensitivity 1, so that nothing is seen.
/// Under the default conditions that is beyond 43.6 degrees on the temporal side. At the fovea they
/// give 71 cycles per degree, beyond the 64 that the model was fitted to.
class StelaAcuity final : public AcuityModel {
  public:
    /// Errors: as check_conditions.
    static Expected<std::unique_ptr<StelaAcuity>> create(const StelaConditions& conditions,
                                                         StelaField field);

    [[nodiscard]] std::string_view name() const override { return "stelacsf"; }
    [[nodiscard]] double cutoff_cpd(double eccentricity_deg, double nasal) const override;

  private:
    StelaAcuity(const StelaConditions& conditions, StelaField field);

    /// The eccentricity at which the grating of a table entry just disappears.
    [[nodiscard]] double reach_deg(std::size_t entry, const StelaDecay& decay) const;

    StelaField field_;
    std::vector<double> log10_sensitivity_;  ///< at the fovea, by frequency
};

}  // namespace gazeloop::foveation
