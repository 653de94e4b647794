#pragma once

#include "runtime/gaze/events/seen_motion.h"

namespace gazeloop::gaze {

/// How much wider than the error of a resting gaze the fovea must be, degrees, for what the eyes
/// may have done since the newest sample, `ahead_s` before the frame is shown:
///
/// - At rest, for a share of the largest saccade that can have begun and landed unseen. Most that
///   do are smaller, and one in flight is not seen by its own eye. Where gaze is shown late, for
///   all of it but some degrees.
/// - Once the newest sample departs from rest, for the saccade that this may be.
/// - In a saccade, and so after its landing until samples show it, for what the forecast leaves:
///   most when it has just begun.
/// - Just found again after a loss, for what happened meanwhile.
///
/// Of the last three no more than an eye moves in `ahead_s`. NaN counts as 0. Chosen on simulated
/// persons (tests/support/misses), reported on others by
/// `./dev bench misses`.
[[nodiscard]] double event_widening_deg(const SeenMotion& seen, double ahead_s);

/// The same while the gaze is lost, `lost_s` after its last sample, at so many deg/s: a blink keeps
/// the eye covered at first.
[[nodiscard]] double lost_widening_deg(double lost_s, double deg_per_s);

/// Whether a saccade is still under way when a frame is shown, `ahead_s` after the newest sample,
/// and goes on for `margin_s` after that: the eye sees little of it.
[[nodiscard]] bool shown_in_flight(const SeenMotion& seen, double ahead_s, double margin_s);

}  // namespace gazeloop::gaze
