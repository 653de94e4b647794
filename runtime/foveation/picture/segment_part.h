#pragma once

#include <algorithm>
#include <numbers>

namespace gazeloop::foveation {

/// What half-planes leave of a segment from a to b, as parameters: 0 at a, 1 at b.
struct SegmentPart {
    double from = 0.0;
    double to = 1.0;

    /// Cuts by a function that is linear along the segment and not negative on what is kept. The
    /// arguments are its values at the whole segment's ends.
    void clip(double at_a, double at_b) {
        if (at_a < 0.0 && at_b < 0.0) {
            to = -1.0;
        } else if (at_a < 0.0) {
            from = std::max(from, at_a / (at_a - at_b));
        } else if (at_b < 0.0) {
            to = std::min(to, at_a / (at_a - at_b));
        }
    }
    [[nodiscard]] bool empty() const { return from > to; }
};

/// Half a turn or more is no convex wedge any more: it is taken as every direction.
[[nodiscard]] inline bool is_every_direction(double from_rad, double to_rad) {
    return to_rad - from_rad >= std::numbers::pi * 0.999;
}

}  // namespace gazeloop::foveation
