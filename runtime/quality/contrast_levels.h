#pragma once

#include <array>
#include <vector>

#include "runtime/foveation/picture/gaze_field.h"
#include "runtime/gaze/eye.h"
#include "runtime/quality/band_sensitivity.h"
#include "runtime/quality/plane.h"
#include "runtime/quality/row_work.h"

namespace gazeloop::quality {

/// The pyramid of one eye's picture in the visual field: how fine each band is at each place, and
/// what the eye loses there. The display decides the former, the gaze the latter.
class ContrastLevels {
  public:
    struct Level {
        std::uint32_t width = 0;
        std::uint32_t height = 0;
        double band_gain = 1.0;  ///< by which the band's contrasts are divided
        Plane log2_cpd;          ///< what the band stands for; the rest's is at least kRestCpd
        Plane weight;            ///< each pixel's solid angle; the sum is 1
        /// log2 by which sensitivity falls with eccentricity, by mechanism; the transient one
        /// falls as the sustained.
        std::array<Plane, kStillMechanisms> decay;
    };

    /// Low-passed to below this nothing is split further, and what is left counts as of this
    /// frequency, since contrast sensitivity says nothing of fields without end.
    static constexpr double kRestCpd = 0.5;

    /// Precondition: gaze::is_valid(view), sides as GazeField takes them.
    ContrastLevels(const gaze::EyeView& view, gaze::Eye eye, const RowWork& work);

    /// Turns the field to a gaze. Precondition: `field` is of this view.
    void look(const foveation::GazeField& field, const RowWork& work);

    /// The bands from fine to coarse, then the rest.
    [[nodiscard]] const std::vector<Level>& levels() const { return levels_; }
    [[nodiscard]] std::size_t bands() const { return levels_.size() - 1; }

  private:
    gaze::Eye eye_;
    std::vector<Level> levels_;
};

}  // namespace gazeloop::quality
