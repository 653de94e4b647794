#pragma once

#include <span>
#include <vector>

#include "runtime/foveation/log_polar/acuity_profile.h"
#include "tests/support/misses/shown_gaze.h"

namespace gazeloop::tests {

/// What the acuity-derived map shades directly, and what a picture costs, by how far the fovea is
/// widened. Samples are those of a gaze in the middle of the view.
class SharpRegion {
  public:
    /// Throws SetupError for a view that the map refuses.
    explicit SharpRegion(const gaze::EyeView& view);

    /// Degrees around the fovea that are as sharp as the display; widened by so many degrees.
    [[nodiscard]] double radius_deg(double widening_deg) const;
    /// Shaded for a picture.
    [[nodiscard]] double samples(double widening_deg) const;

  private:
    foveation::AcuityProfile profile_;
    double plain_deg_ = 0.0;  ///< the radius without widening
    std::vector<double> samples_;
};

/// Which frames count: the eye sees nothing under its lids, and little in flight.
enum class Counted { Seen, SeenOrInFlight };

/// Share of the frames whose true gaze lies outside the sharp region, %. Widened by what the foveae
/// say, or by as much everywhere.
[[nodiscard]] double misses_percent(std::span<const ShownGaze> shown, const SharpRegion& sharp,
                                    Counted counted);
[[nodiscard]] double misses_percent(std::span<const ShownGaze> shown, const SharpRegion& sharp,
                                    Counted counted, double widening_deg);
/// The least constant widening that misses no more than that, degrees.
[[nodiscard]] double constant_widening_deg(std::span<const ShownGaze> shown,
                                           const SharpRegion& sharp, Counted counted,
                                           double misses_percent);
/// Samples per picture, the mean over all frames.
[[nodiscard]] double mean_samples(std::span<const ShownGaze> shown, const SharpRegion& sharp);

}  // namespace gazeloop::tests
