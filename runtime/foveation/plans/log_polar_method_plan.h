#pragma once

#include "runtime/foveation/log_polar/map_tables.h"
#include "runtime/foveation/plans/log_polar_plan.h"

namespace gazeloop::foveation {

/// The plan of a method with one LP-buffer, and the map that its shaders follow.
class LogPolarMethodPlan : public MethodPlan {
  public:
    [[nodiscard]] const frame::GridList& grids() const final { return log_polar_grids(); }
    /// Whether the map is centred by a rotation into the gaze's frame or, in the picture, by a
    /// translation.
    [[nodiscard]] virtual bool in_gaze_frame() const = 0;
    /// Precondition, here and below: prepare().
    [[nodiscard]] virtual LpSize lp(gaze::Eye eye) const = 0;
    [[nodiscard]] virtual MapTables tables(gaze::Eye eye) const = 0;
};

}  // namespace gazeloop::foveation
