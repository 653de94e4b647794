#pragma once

#include <optional>
#include <string>

#include "drivers/hid/eye_tracker_reports.h"
#include "runtime/gaze/gaze_sample.h"

namespace gazeloop::drivers::hid {

/// The screen that the gaze point lies on, and where its viewer is where the tracker does not say.
/// Metres; 0: unknown.
struct ScreenGeometry {
    double width_m = 0.0;
    double height_m = 0.0;
    double viewing_distance_m = 0.0;  ///< of eyes in front of the screen's middle
    double eye_distance_m = 0.063;    ///< between the eyes, for where only one or none is seen

    /// Whether a ray can be told without eye positions.
    [[nodiscard]] bool complete() const {
        return width_m > 0.0 && height_m > 0.0 && viewing_distance_m > 0.0;
    }
};

/// From a point on a screen to a ray of each eye, in the head frame: its origin lies midway between
/// the eyes and its axes are parallel to the screen's (+X right, +Y up, -Z into the screen),
/// because a tracker of this kind does not say how the head is turned.
///
/// An eye that the report has is where the report says. With only one of them known, the other is
/// not (its direction would be a guess, and the gaze of the one serves both). With neither known,
/// both are taken from the geometry. An eye is valid if there is a gaze point and the eye is in
/// front of the screen.
[[nodiscard]] gaze::PerEye<gaze::EyeRay> eye_rays(const TrackingReport& report,
                                                  const ScreenGeometry& geometry);

/// Why no ray can be told from this tracker's reports, and the remedy; none where it can.
[[nodiscard]] std::optional<std::string> geometry_problem(const EyeTrackerLayout& layout,
                                                          const ScreenGeometry& geometry);

}  // namespace gazeloop::drivers::hid
