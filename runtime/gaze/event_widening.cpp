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
constexpr double kUnseenShare = 0.2;
// What departs by fewer deviations is noise, by more is a saccade.
constexpr double kQuiet = 2.0;
constexpr double kMoves = 3.5;
constexpr double kMoving_deg = 10.0;
constexpr double kFlying_deg = 7.5;
constexpr double kTakingOff_deg = 4.0;  // beyond that, at first
constexpr double kTakingOff_s = 8e-3;
constexpr double kFoundAgain_deg = 5.0;
constexpr double kCovered_s = 0.06;  // of the shortest blinks

double not_negative(double value) { return std::isnan(value) ? 0.0 : std::max(value, 0.0); }

double unseen_deg(double ahead_s) {
    const double largest_deg =
        (not_negative(ahead_s) + kNoticed_s - kShortestSaccade_s) / kSecondsPerDeg;
    return kUnseenShare * std::clamp(largest_deg, 0.0, kLargestSaccade_deg);
}

}  // namespace

double event_widening_deg(const SeenMotion& seen, double ahead_s) {
    const double unseen = unseen_deg(ahead_s);
    switch (seen.event) {
        case EyeEvent::Saccade:
            return std::max(
                unseen, kFlying_deg +
                            kTakingOff_deg * std::exp(-not_negative(seen.since_s) / kTakingOff_s));
        case EyeEvent::Lost:
            return std::max(unseen, kFoundAgain_deg);
        case EyeEvent::Fixation:
        case EyeEvent::Pursuit:
        case EyeEvent::Oscillation:
            break;
    }
    const double moves =
        std::clamp((not_negative(seen.departure) - kQuiet) / (kMoves - kQuiet), 0.0, 1.0);
    return std::max(unseen, moves * kMoving_deg);
}

double lost_widening_deg(double lost_s, double deg_per_s) {
    return unseen_deg(lost_s) + deg_per_s * std::max(not_negative(lost_s) - kCovered_s, 0.0);
}

bool shown_in_flight(const SeenMotion& seen, double ahead_s, double margin_s) {
    return seen.event == EyeEvent::Saccade &&
           seen.flies_on_s > not_negative(ahead_s) + not_negative(margin_s);
}

}  // namespace gazeloop::gaze
