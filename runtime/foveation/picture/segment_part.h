#pragma once

#include <algorithm>
#include <numbers>

namespace gazeloop::foveation {

/// The part of a segment from a to b that half-planes leave, by parameters: 0 at a, 1 at b.
struct SegmentPart {
    double from = 0.0;
    double to = 1.0;

    /// Keeps the part on which a linear function is not negative. The arguments are the function's
    /// values at the ends of the whole segment.
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

/// A wedge of half a turn or more is not convex, and is taken as every direction.
[[nodiscard]] inline bool is_every_direction(double from_rad, double to_rad) {
    return to_rad - from_rad >= std::numbers::pi * 0.999;
}

}  // namespace gazeloop::foveation
