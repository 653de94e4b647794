#pragma once

#include <optional>
#include <string>

#include "drivers/hid/eye_tracker_reports.h"
#include "runtime/gaze/gaze_sample.h"

namespace gazeloop::drivers::hid {

/// The screen that the gaze point lies on, and where its viewer is if the tracker does not say.
/// Metres; 0: unknown.
struct ScreenGeometry {
    double width_m = 0.0;
    double height_m = 0.0;
    double viewing_distance_m = 0.0;  ///< of eyes in front of the screen's middle
    double eye_distance_m = 0.063;    ///< between the eyes, for where only one or none is seen

    /// Whether rays can be computed without eye positions.
    [[nodiscard]] bool complete() const {
        return width_m > 0.0 && height_m > 0.0 && viewing_distance_m > 0.0;
    }
};

/// From a point on a screen to a ray of each eye, in the head frame. That frame's origin lies
/// midway between the eyes. Its axes are parallel to the screen's (+X right, +Y up, -Z into the
/// screen), because a tracker of this kind does not say how the head is turned.
///
/// An eye that the report has is where the report says. If it has only one, the other stays
/// unknown: its direction would be a guess, and the gaze of the known eye serves both. If it has
/// neither, both are taken from the geometry. An eye is valid if there is a gaze point and the eye
/// is in front of the screen.
[[nodiscard]] gaze::PerEye<gaze::EyeRay> eye_rays(const TrackingReport& report,
                                                  const ScreenGeometry& geometry);

/// Why no ray can be computed from this tracker's reports, and the remedy; none where one can.
[[nodiscard]] std::optional<std::string> geometry_problem(const EyeTrackerLayout& layout,
                                                          const ScreenGeometry& geometry);

}  // namespace gazeloop::drivers::hid
