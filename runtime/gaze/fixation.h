#pragma once

#include <optional>

#include "runtime/gaze/combined_gaze.h"
#include "runtime/gaze/seen_depth.h"

namespace gazeloop::gaze {

/// How near what somebody looks at is: 1 / distance from the gaze's origin, 1/m; 0: infinitely far.
struct Fixation {
    double nearness = 0.0;
    /// Between what distances it may be, since a tracker does not know better than
    /// kTrackerAccuracy_rad where somebody looks; `nearness` lies within.
    DistanceRange range;
};

/// How far off headsets' trackers are: about a degree (config/trackers has what is known of each).
inline constexpr double kTrackerAccuracy_rad = 0.01745;

/// Nearer than that nothing is looked for: it is about what eyes of twenty years can still focus
/// (Duane 1912), and where depth images end.
inline constexpr double kNearestLook_m = 0.1;

/// Where a combined gaze, given in the world, meets what pictures of both eyes show. None where
/// neither shows it.
///
/// In an eye's picture the points of the gaze lie on a line, from where it is infinitely far to
/// where it is near. The sample at such a point is hit if the surface that it shows lies on the
/// gaze, to within a sample's spacing in the picture; else the eye sees past it, or something hides
/// it. Each hit is a surface on the gaze, and the nearest one of both eyes is what is looked at:
/// what hides a point from one eye beside an edge hides it not from the other.
///
/// So the answer depends on the gaze and the scene, not on the distance that the pictures' foveae
/// were made for: there is no feedback that could oscillate. That distance decides only which part
/// of the line lies within the patches. They lie around it, so that what was hit once is hit again
/// when the foveae follow, and only something nearer can take its place.
///
/// The range is that of all surfaces that either eye sees within kTrackerAccuracy_rad of the gaze.
/// It reaches to infinity where neither patch shows the gaze there, and up to kNearestContent_m to
/// what nearer part of it neither shows.
[[nodiscard]] std::optional<Fixation> find_fixation(const CombinedGaze& gaze_in_world,
                                                    const SeenDepth& seen);

}  // namespace gazeloop::gaze
