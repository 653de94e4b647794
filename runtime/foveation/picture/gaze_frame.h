#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "runtime/gaze/view.h"

namespace gazeloop::foveation {

/// A direction as seen from the gaze.
struct GazePolar {
    double rho = 0.0;        ///< tan(e / 2) of the eccentricity e; infinite straight behind
    double angle_rad = 0.0;  ///< [0, 2 pi), from the screen's x towards its y (down)
};

/// The frame of one eye's gaze: z along the gaze, x and y as the screen's (right and down). It is
/// turned with the gaze by the smallest rotation from straight ahead. Because rays are rotated,
/// eccentricity is an angle wherever the gaze is. That holds for asymmetric and canted views, and
/// for a gaze beyond the screen or more than 90 degrees away from it.
class GazeFrame {
  public:
    /// `gaze` in the view frame, of any length; one that is zero or not finite is straight ahead.
    /// Precondition: is_valid(view).
    GazeFrame(const gaze::EyeView& view, const glm::dvec3& gaze);

    [[nodiscard]] GazePolar polar(const gaze::PixelPosition& position) const;
    /// Nothing for what lies at or behind the picture's plane.
    [[nodiscard]] std::optional<gaze::PixelPosition> position(const GazePolar& polar) const;
    [[nodiscard]] double eccentricity_rad(const gaze::PixelPosition& position) const;

    /// Takes (x_px, y_px, 1) to the ray in this frame. The ray's length is 1 / cos of its angle
    /// from the view's axis.
    [[nodiscard]] const glm::dmat3& gaze_from_picture() const { return gaze_from_picture_; }
    /// A rotation: this frame's axes, in the view frame.
    [[nodiscard]] const glm::dmat3& view_from_gaze() const { return view_from_gaze_; }
    [[nodiscard]] const gaze::EyeView& view() const { return view_; }
    /// The gaze, in the view frame. Where it is beyond the picture: the picture's point nearest to
    /// its projection.
    [[nodiscard]] glm::dvec3 nearest_in_view() const;

    struct RhoRange {
        double min = 0.0;
        double max = 0.0;
    };
    /// The range of rho over a convex polygon of the picture, within the wedge of angles from
    /// `from_rad` to `to_rad` (to > from); exact. `polygon`: its corners, px, in the order in which
    /// angles grow. Nothing if the wedge misses the polygon, or the polygon has no corner.
    [[nodiscard]] std::optional<RhoRange> rho_in_wedge(std::span<const glm::dvec2> polygon,
                                                       double from_rad, double to_rad) const;
    /// The same of the rectangle that the pixel centres span.
    [[nodiscard]] std::optional<RhoRange> on_screen(double from_rad, double to_rad) const;
    /// The same of any rectangle, in every direction.
    [[nodiscard]] RhoRange rho_over(const gaze::PixelPosition& corner,
                                    const gaze::PixelPosition& opposite) const;

    /// A range of pixel centres in one row of the picture, px.
    struct RowSpan {
        double from_x_px = 0.0;
        double to_x_px = 0.0;
    };
    /// The part of a row within an eccentricity of the gaze, clipped to the row; nothing if there
    /// is none. Exact up to 90 degrees; beyond, it may be too wide.
    [[nodiscard]] std::optional<RowSpan> row_within(double y_px, double eccentricity_rad) const;

  private:
    [[nodiscard]] glm::dvec3 ray(double x_px, double y_px) const {
        return gaze_from_picture_ * glm::dvec3(x_px, y_px, 1.0);
    }

    gaze::EyeView view_;
    glm::dmat3 view_from_gaze_{1.0};
    glm::dmat3 gaze_from_picture_{1.0};
};

/// Pixels of the view's picture per unit of tangent: to the right (positive) and upward (negative).
[[nodiscard]] glm::dvec2 px_per_tangent(const gaze::EyeView& view);

/// Pixels per degree of the view's picture in one direction of the view frame: along the finest
/// axis there, and the geometric mean of the finest and the coarsest. The mean's square is pixels
/// per square degree. Precondition: is_valid(view).
struct PixelsPerDegree {
    double finest = 0.0;
    double mean = 0.0;
};
PixelsPerDegree pixels_per_degree(const gaze::EyeView& view, const glm::dvec3& direction);

/// The finest in view: at a corner of the picture.
double most_pixels_per_degree(const gaze::EyeView& view);

}  // namespace gazeloop::foveation
