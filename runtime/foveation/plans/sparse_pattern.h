#pragma once

#include <cstdint>
#include <vector>

#include "runtime/error.h"
#include "runtime/foveation/log_polar/log_polar_map.h"
#include "runtime/foveation/picture/image_size.h"
#include "runtime/foveation/picture/offered_density.h"

namespace gazeloop::foveation {

/// How a sparse pattern's samples are placed.
enum class SparsePlacement {
    Gaussian,   ///< independent draws: clumps and holes
    BlueNoise,  ///< the same density and count, no two samples closer than the density allows
};

/// Sparse sampling ("Fooling around with foveated rendering"). Samples are every pixel of a disc
/// around the gaze, and pixels drawn from a narrow and a wide Gaussian around it. All other pixels
/// are filled from the nearest samples. The article gives only the shares 1/10 and 1/5; the other
/// figures are ours, with lengths relative to the picture's diagonal.
struct SparseParameters {
    static constexpr double kMinShare = 0.001;
    static constexpr double kMaxShare = 1.0;  ///< every pixel
    static constexpr double kMinSpread = 0.01;
    static constexpr double kMaxSpread = 2.0;

    double share = 0.1;          ///< samples per pixel, gaze at the centre; [kMinShare, kMaxShare]
    double disc_share = 0.25;    ///< share of the samples that the disc takes; [0, .9]
    double narrow_share = 0.4;   ///< share of the draws from the narrow Gaussian; [0, 1]
    double narrow_spread = 0.1;  ///< its SD; [kMinSpread, kMaxSpread]
    double wide_spread = 0.3;    ///< SD of the wide one; the same range
    SparsePlacement placement = SparsePlacement::Gaussian;
    std::uint64_t seed = 1;  ///< the same seed gives the same pattern, everywhere
};

/// A pixel of the field.
struct FieldPixel {
    std::uint16_t x = 0;
    std::uint16_t y = 0;
    friend auto operator<=>(const FieldPixel&, const FieldPixel&) = default;
};

/// What the density of a pattern follows.
struct SparseProfile {
    double disc_radius_px = 0.0;
    double narrow_px = 0.0;  ///< standard deviations
    double wide_px = 0.0;
    double narrow_draws = 0.0;  ///< over the whole plane
    double wide_draws = 0.0;

    /// Share of the pixels at this distance from the gaze that are samples. It is 1 in the disc;
    /// outside it is 1 - exp(-expected draws), because a pixel drawn twice is one sample.
    [[nodiscard]] double share(double radius_px) const;
};

/// Samples in a field of 2 W x 2 H pixels whose middle is the gaze. For any gaze in the picture,
/// the picture is a window of the field, so that nothing is computed anew when the gaze moves.
struct SparsePattern {
    ImageSize image;  ///< W x H
    SparseProfile profile;
    std::vector<FieldPixel> samples;  ///< each once; by y, then x

    [[nodiscard]] ImageSize field() const { return {2 * image.width_px, 2 * image.height_px}; }

    /// Where the picture's top left pixel lies in the field for a gaze. The gaze is rounded to a
    /// pixel corner; outside the picture, its edge is taken. Precondition: fovea finite.
    [[nodiscard]] FieldPixel window(const gaze::PixelPosition& fovea) const;

    /// Samples that fall into the picture at this gaze. Precondition: fovea finite.
    [[nodiscard]] std::uint64_t samples_in(const gaze::PixelPosition& fovea) const;
};

/// Makes a pattern with exactly round(share W H) samples, at least 1, in the picture with the gaze
/// at its centre. Errors (Usage):
///  - a parameter out of range or not a number;
///  - a picture without pixels, or with a side over 16384;
///  - a share that the Gaussians are too narrow to fill.
Expected<SparsePattern> make_sparse_pattern(const SparseParameters& parameters, ImageSize image);

/// What a pattern offers: the square grid of the same density.
class SparseDensity final : public OfferedDensity {
  public:
    SparseDensity(const SparseProfile& profile, const gaze::PixelPosition& fovea)
        : profile_(profile), fovea_(fovea) {}

    [[nodiscard]] SampleGrid at(const FieldPoint& at) const override;

  private:
    SparseProfile profile_;
    gaze::PixelPosition fovea_;
};

}  // namespace gazeloop::foveation
