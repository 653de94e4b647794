#pragma once

#include <glm/mat2x2.hpp>
#include <optional>

#include "runtime/error.h"
#include "runtime/foveation/picture/gaze_frame.h"
#include "runtime/foveation/picture/tile.h"
#include "runtime/gaze/view.h"

namespace gazeloop::foveation {

/// A pixel position as the eye sees it from its gaze.
struct FieldPoint {
    gaze::PixelPosition pixel;
    double eccentricity_deg = 0.0;  ///< the true angle from the gaze, not a distance in pixels
    /// Around the gaze: 0 to the right, counter-clockwise. It turns with the gaze as GazeFrame
    /// does, which is how an eye turns (Listing's law).
    double direction_rad = 0.0;
    /// How the pixel position moves. First column: by one degree outward from the gaze. Second
    /// column: by one degree of visual angle (not of direction) counter-clockwise around it.
    glm::dmat2 px_per_deg{1.0};
};

/// The visual field around one gaze, on one eye's flat picture: a checked GazeFrame, in degrees,
/// with what models and plans ask of it. On a flat picture, a circle of eccentricity around an
/// off-axis gaze is no circle in pixels. So whatever depends on acuity has to be computed here.
class GazeField {
  public:
    /// `gaze_direction` in the view frame, of any length. Errors (Usage): a view that is not valid
    /// (gaze::is_valid) or has a side over kMaxSidePx; a direction that is zero or not finite.
    static Expected<GazeField> create(const gaze::EyeView& view, const glm::dvec3& gaze_direction);

    static constexpr std::uint32_t kMaxSidePx = 16384;

    [[nodiscard]] const gaze::EyeView& view() const { return frame_.view(); }
    [[nodiscard]] const GazeFrame& frame() const { return frame_; }
    /// The gaze, in the view frame; unit length.
    [[nodiscard]] const glm::dvec3& gaze() const { return frame_.view_from_gaze()[2]; }

    /// Where the gaze falls in the picture (or beyond it: gaze::project).
    [[nodiscard]] gaze::PixelPosition fovea() const { return gaze::project(gaze(), view()); }

    /// The field at a pixel position, in the picture or beyond it.
    [[nodiscard]] FieldPoint at(const gaze::PixelPosition& pixel) const;

    /// The field at an eccentricity in [0, 180] and a direction. Nothing outside the picture.
    [[nodiscard]] std::optional<FieldPoint> at(double eccentricity_deg, double direction_rad) const;

    /// Square degrees that a pixel covers.
    [[nodiscard]] double pixel_area_deg2(const gaze::PixelPosition& pixel) const;

    /// The least angle between the gaze and any point of a rectangle of the picture, degrees.
    [[nodiscard]] double least_eccentricity_deg(const gaze::PixelPosition& corner,
                                                const gaze::PixelPosition& opposite) const;

    /// The rectangle of whole pixels around the cone of an eccentricity in [0, 180], cut by the
    /// picture. From 90 degrees on, and where the cone's edge passes behind the picture, it spans
    /// the whole axis. Empty where the cone misses the picture.
    [[nodiscard]] Tile pixels_within(double eccentricity_deg) const;

    /// The greatest eccentricity in the picture.
    [[nodiscard]] double greatest_eccentricity_deg() const;

  private:
    explicit GazeField(const GazeFrame& frame) : frame_(frame) {}

    [[nodiscard]] FieldPoint point(const gaze::PixelPosition& pixel, const GazePolar& polar) const;

    GazeFrame frame_;
};

}  // namespace gazeloop::foveation
