#pragma once

#include <memory>

#include "runtime/error.h"
#include "runtime/foveation/eye/acuity_model.h"
#include "runtime/foveation/eye/mar_line.h"

namespace gazeloop::foveation {

/// Guenter et al. 2012: the cut-off is 1 / omega(e), omega(e) = m e + omega0.
class GuenterAcuity final : public AcuityModel {
  public:
    /// Errors: as check_mar_line.
    static Expected<std::unique_ptr<GuenterAcuity>> create(const MarLine& line);

    [[nodiscard]] std::string_view name() const override { return "guenter"; }
    [[nodiscard]] double cutoff_cpd(double eccentricity_deg, double nasal) const override;

  private:
    explicit GuenterAcuity(const MarLine& line) : line_(line) {}

    MarLine line_;
};

}  // namespace gazeloop::foveation
