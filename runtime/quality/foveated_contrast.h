#pragma once

#include <array>
#include <memory>

#include "runtime/error.h"
#include "runtime/gaze/eye.h"
#include "runtime/gaze/view.h"
#include "runtime/quality/band_sensitivity.h"
#include "runtime/quality/opponent_planes.h"
#include "runtime/quality/plane.h"
#include "runtime/render/host_picture.h"

namespace gazeloop::quality {

/// What one frame differs by, in thresholds: 0 is identical; 1 is a difference that this model
/// takes to be just seen, all over the field.
struct ContrastDifference {
    double value = 0.0;                            ///< root of the mechanisms' sum of squares
    std::array<double, kMechanisms> mechanisms{};  ///< each alone
    /// Where: thresholds per pixel. Its root mean square over solid angle is the value. Empty if
    /// it was not asked for.
    Plane map;
};

struct ContrastOptions {
    DisplayLight light{};
    unsigned threads = 0;  ///< 0: as many as the machine has
};

/// A foveated contrast metric of our own. Both pictures become luminance and two channels of
/// colour, in cd/m2; of sequences, what stays and what changes (temporal_filter.h). Each channel's
/// Laplacian pyramid gives contrasts, over the luminance that the band rests on (the mean of both
/// pictures). A difference of contrasts is weighed by the sensitivity at its frequency,
/// luminance and eccentricity (band_sensitivity.h), all in true angles. It is masked by the
/// contrast that both pictures have in that band around it, by
///
///     d = |S dC| / (1 + (S C)^2.8)^(1/4)
///
/// (Daly 1993, whose threshold elevation this is for a slope of .7). Squares are added over bands
/// and mechanisms, and averaged over the solid angle of the picture.
///
/// Exactly symmetric. The same bits with any number of threads. Not modelled: crowding, glare,
/// adaptation in time, a picture that moves on the retina as the eye turns, saccadic suppression.
///
/// It takes some 100 bytes per pixel for the work, and a sequence 96 more for the past.
class FoveatedContrast {
  public:
    /// The display's geometry, with as many pixels as the pictures have. Errors (Usage): a view
    /// that is not valid or too large, an option out of range.
    static Expected<FoveatedContrast> create(const gaze::EyeView& view, gaze::Eye eye,
                                             const ContrastOptions& options);
    FoveatedContrast(const FoveatedContrast&) = delete;
    FoveatedContrast& operator=(const FoveatedContrast&) = delete;
    FoveatedContrast(FoveatedContrast&&) noexcept;
    FoveatedContrast& operator=(FoveatedContrast&&) noexcept;
    ~FoveatedContrast();

    /// Two still pictures, seen with this gaze (in the view frame, of any length). Errors: pictures
    /// that cannot be compared or are not of the view's size (BadInput), a gaze that is no
    /// direction (Usage).
    Expected<ContrastDifference> still(const render::LinearPicture& reference,
                                       const render::LinearPicture& test, const glm::dvec3& gaze,
                                       bool with_map = false);

    /// The next frame of two sequences, which is shown for `seconds`. Errors: as still(); also a
    /// time that is not in (0, kMaxFrameSeconds] (Usage).
    Expected<ContrastDifference> next(const render::LinearPicture& reference,
                                      const render::LinearPicture& test, const glm::dvec3& gaze,
                                      double seconds, bool with_map = false);
    static constexpr double kMaxFrameSeconds = 10.0;

    /// The next frame is the first of a sequence again.
    void forget();

  private:
    class Work;
    explicit FoveatedContrast(std::unique_ptr<Work> work);
    std::unique_ptr<Work> work_;
};

}  // namespace gazeloop::quality
