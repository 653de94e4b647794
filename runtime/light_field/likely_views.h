#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "runtime/light_field/lens.h"

namespace gazeloop::light_field {

/// One eye's lens as it moves over the cameras.
struct MovingLens {
    glm::dvec2 middle_m{};  ///< now
    glm::dvec2 step_m{};    ///< from frame to frame; {}: it stands, or nothing is known of it
};

/// Tells which views will be asked for soon.
class LikelyViews {
  public:
    /// Precondition: check(field.cameras).
    explicit LikelyViews(const LightField& field);

    /// The views that no lens asks for now and one may within ten frames, the soonest first. A lens
    /// goes on as it moves, and may turn aside by a tenth of the cameras' spacing a frame: so one
    /// that stands is likely to ask for what lies around it, the nearest first. A step that is
    /// longer than the lens reaches is a jump, after which it counts as one that stands. Valid
    /// until the next call. No allocation.
    [[nodiscard]] std::span<const std::uint32_t> after(std::span<const MovingLens> lenses);

  private:
    struct Soon {
        double frames = 0.0;
        std::uint32_t view = 0;
    };

    LightField field_;
    std::vector<Soon> soon_;
    std::vector<std::uint32_t> views_;
};

}  // namespace gazeloop::light_field
