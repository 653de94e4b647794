#pragma once

#include <optional>

#include "runtime/gaze/combined_gaze.h"
#include "runtime/gaze/seen_depth.h"

namespace gazeloop::gaze {

/// How near what somebody looks at is: 1 / distance from the gaze's origin, 1/m; 0: infinitely far.
struct Fixation {
    double nearness = 0.0;
    /// The distances between which it may be, because a tracker knows only to within
    /// kTrackerAccuracy_rad where somebody looks. `nearness` lies within.
    DistanceRange range;
};

/// How far off headsets' trackers are: about a degree (config/trackers has what is known of each).
inline constexpr double kTrackerAccuracy_rad = 0.01745;

/// Nothing nearer than this is looked for. It is about the nearest that 20-year-old eyes can focus
/// (Duane 1912), and where depth images end.
inline constexpr double kNearestLook_m = 0.1;

/// Where a combined gaze, given in the world, meets what pictures of both eyes show. None where
/// neither shows it.
///
/// In an eye's picture the points of the gaze lie on a line, from infinitely far to near. The
/// sample at such a point is a hit if the surface that it shows lies on the gaze, to within a
/// sample's spacing in the picture. Else the eye sees past the point, or something hides it. Each
/// hit is a surface on the gaze, and the nearest hit of both eyes is what is looked at. Beside an
/// edge, what occludes a point for one eye does not occlude it for the other.
///
/// So the answer depends on the gaze and the scene, not on the distance that the pictures' foveae
/// were made for: there is no feedback that could oscillate. That distance decides only which part
/// of the line lies within the patches. The patches lie around it. So what was hit once is hit
/// again when the foveae follow, and only something nearer can take its place.
///
/// The range is that of all surfaces that either eye sees within kTrackerAccuracy_rad of the gaze.
/// The range extends to infinity where neither patch shows the far end of the gaze. It extends to
/// the near part that neither patch shows, but no nearer than kNearestContent_m.
[[nodiscard]] std::optional<Fixation> find_fixation(const CombinedGaze& gaze_in_world,
                                                    const SeenDepth& seen);

}  // namespace gazeloop::gaze
