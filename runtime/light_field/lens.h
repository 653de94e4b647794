#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "runtime/light_field/camera_grid.h"

namespace gazeloop::light_field {

/// The thin lens that pictures of a light field are taken with. It lies in the cameras' plane, in
/// front of the eye; what lies on its focal plane is sharp, the rest is as blurred as its opening
/// is wide (dynamically reparameterised light fields, Isaksen et al. 2000).
struct Lens {
    double focus_m = 2.0;      ///< of the focal plane from the cameras' plane; [.01, 1e4]
    double aperture_m = 0.01;  ///< radius of the opening; [0, 1e3]
    bool every_view = false;   ///< list views that weigh nothing too, to measure what that costs
};

/// What a scene says of itself, if it is a light field.
struct LightField {
    CameraGrid cameras;
    Lens lens;
};

/// Cameras that are nearer to the lens's middle than this weigh something.
[[nodiscard]] double reach_m(const LightField& field);

/// No fewer than the views that one eye's picture may be made of, wherever the eye is: at most a
/// tenth more for a lens that is wider than three spacings. Precondition: check(cameras).
[[nodiscard]] std::uint32_t most_views(const LightField& field);

/// A view that a picture is made of.
struct WeightedView {
    std::uint32_t view = 0;
    glm::dvec2 camera_m{};
    double weight = 0.0;  ///< the weights of a picture's views sum to 1
};

/// The views that make up what one eye sees. A camera at the distance d from the lens's middle
/// weighs clamp((aperture_m - d) / spacing_m + 1, 0, 1): whole inside the opening, less and less
/// over one spacing outside it, so that no view jumps in as the eye moves. An opening of 0
/// interpolates between the nearest cameras. The lens's middle is the eye's place in the cameras'
/// plane, or where their rectangle ends the nearest point of it: so some camera always weighs over
/// .29.
class ViewsInLens {
  public:
    /// Precondition: check(cameras). An eye that is not a number counts as one in the middle.
    ViewsInLens(const LightField& field, const glm::dvec3& eye_m);

    [[nodiscard]] const glm::dvec2& middle_m() const { return middle_m_; }
    /// The distance from the lens's middle to the farthest camera that weighs something.
    [[nodiscard]] double reach_m() const { return reach_m_; }

    /// Calls `visit(const WeightedView&)` for each view, row by row. No allocation.
    template <typename Visit>
    void for_each(const Visit& visit) const {
        for_cameras([&](const WeightedView& view) {
            if (view.weight > 0.0 || field_.lens.every_view) {
                visit(WeightedView{view.view, view.camera_m, view.weight / sum_});
            }
        });
    }

  private:
    template <typename Visit>
    void for_cameras(const Visit& visit) const {
        for (std::uint32_t row = 0; row < field_.cameras.rows; ++row) {
            for (std::uint32_t column = 0; column < field_.cameras.columns; ++column) {
                const glm::dvec2 at_m = field_.cameras.camera_m(column, row);
                visit(WeightedView{row * field_.cameras.columns + column, at_m, weight(at_m)});
            }
        }
    }
    [[nodiscard]] double weight(const glm::dvec2& camera_m) const;

    LightField field_;
    glm::dvec2 middle_m_{};
    double reach_m_ = 0.0;
    double sum_ = 0.0;
};

}  // namespace gazeloop::light_field
