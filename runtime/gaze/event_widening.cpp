#include "runtime/gaze/event_widening.h"

#include <algorithm>
#include <cmath>

namespace gazeloop::gaze {
namespace {

// Duration of a saccade by the main sequence (main_sequence.h), turned round.
constexpr double kShortestSaccade_s = 15.9e-3;
constexpr double kSecondsPerDeg = 2.54e-3;
constexpr double kLargestSaccade_deg = 20.0;
constexpr double kNoticed_s = 8e-3;  // a saccade shows so late
constexpr double kUnseenShare = 0.17;
// Where gaze is old when it is shown, all but saccades so much smaller than the largest: those have
// landed but just now, which is rare.
constexpr double kRare_deg = 8.0;
constexpr double kMostMoved_deg_per_s = 260.0;  // from a sample that shows it on
// What departs by fewer deviations is noise, by more is a saccade.
constexpr double kQuiet = 2.0;
constexpr double kMoves = 3.5;
constexpr double kMoving_deg = 10.0;
constexpr double kFlying_deg = 5.0;
constexpr double kTakingOff_deg = 7.0;  // beyond that, at first
constexpr double kTakingOff_s = 15e-3;
constexpr double kFoundAgain_deg = 5.0;
constexpr double kCovered_s = 0.06;  // of the shortest blinks

double not_negative(double value) { return std::isnan(value) ? 0.0 : std::max(value, 0.0); }

/// The largest saccade that can begin and land in that time.
double largest_unseen_deg(double time_s) {
    return std::clamp((not_negative(time_s) + kNoticed_s - kShortestSaccade_s) / kSecondsPerDeg,
                      0.0, kLargestSaccade_deg);
}

}  // namespace

double event_widening_deg(const SeenMotion& seen, double ahead_s) {
    double moved_deg = 0.0;
    switch (seen.event) {
        case EyeEvent::Saccade:
            moved_deg =
                kFlying_deg + kTakingOff_deg * std::exp(-not_negative(seen.since_s) / kTakingOff_s);
            break;
        case EyeEvent::Lost:
            moved_deg = kFoundAgain_deg;
            break;
        case EyeEvent::Fixation:
        case EyeEvent::Pursuit:
        case EyeEvent::Oscillation:
            moved_deg =
                kMoving_deg *
                std::clamp((not_negative(seen.departure) - kQuiet) / (kMoves - kQuiet), 0.0, 1.0);
            break;
    }
    const double largest_deg = largest_unseen_deg(ahead_s);
    return std::max({kUnseenShare * largest_deg, largest_deg - kRare_deg,
                     std::min(moved_deg, kMostMoved_deg_per_s * not_negative(ahead_s))});
}

double lost_widening_deg(double lost_s, double deg_per_s) {
    return kUnseenShare * largest_unseen_deg(lost_s) +
           deg_per_s * std::max(not_negative(lost_s) - kCovered_s, 0.0);
}

bool shown_in_flight(const SeenMotion& seen, double ahead_s, double margin_s) {
    return seen.event == EyeEvent::Saccade &&
           seen.flies_on_s > not_negative(ahead_s) + not_negative(margin_s);
}

}  // namespace gazeloop::gaze
