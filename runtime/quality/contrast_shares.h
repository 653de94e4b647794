#pragma once

#include "runtime/error.h"
#include "runtime/foveation/eye/mar_line.h"
#include "runtime/gaze/view.h"
#include "runtime/quality/opponent_planes.h"
#include "runtime/quality/row_work.h"
#include "runtime/render/host_picture.h"

namespace gazeloop::quality {

/// How much of a picture's own contrast lies where, at a gaze: shares of the squares of its bands'
/// contrasts in luminance, over the solid angle. The sum is 1; all 0 where there is no contrast.
/// The larger `between`, the more a picture punishes whoever samples by the line alone.
struct ContrastShares {
    double kept = 0.0;     ///< coarser than the line of acuity
    double between = 0.0;  ///< finer than that, coarser than the limit of resolution
    double beyond = 0.0;   ///< finer than both
    /// Root of the mean square over the solid angle, summed over the bands. They overlap: what lies
    /// between two counts up to 1.3 times.
    double contrast = 0.0;
};

/// By the Laplacian pyramid (pyramid.h), a band counting as an octave around its frequency; what is
/// coarser than ContrastLevels::kRestCpd is no contrast. The limit is ResolutionLimit. Errors: as
/// check_pictures(), check_mar_line() and GazeField::create().
Expected<ContrastShares> contrast_shares(const render::LinearPicture& picture,
                                         const gaze::EyeView& view, const glm::dvec3& gaze,
                                         const foveation::MarLine& line, const DisplayLight& light,
                                         const RowWork& work);

}  // namespace gazeloop::quality
