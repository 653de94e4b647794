#include "runtime/report/smoothing_text.h"

#include <fmt/format.h>

namespace gazeloop::report {
namespace {

using gaze::SmoothingVerdict;

/// "163 saccades peak at .98 (95 % confidence .96 to 1.01) of what ..."
std::string speed_text(const gaze::SmoothingFinding& found) {
    return fmt::format(
        "{} saccades peak at {:.2f} times the main sequence (median; 95 % "
        "confidence {:.2f} to {:.2f}), as this rate of {:.0f} Hz and this noise "
        "show it",
        found.saccades, *found.speed, found.speed_low, found.speed_high, found.rate_hz);
}

std::string time_constant_text(const gaze::SmoothingFinding& found) {
    if (!found.time_constant_ms) {
        return "";
    }
    const bool longest = *found.time_constant_ms >= gaze::GazeSmoothing::kLongestTimeConstant_ms;
    return fmt::format(
        ", as behind an exponential filter with a time constant of about {:.0f} ms"
        "{}, a lag that no stage shows",
        *found.time_constant_ms, longest ? " or more" : "");
}

std::string what_was_looked_at(const gaze::SmoothingFinding& found) {
    std::string text;
    if (found.stopped) {
        text += fmt::format("; only the first {:.0f} s were looked at", found.looked_at_s);
    }
    if (!found.in_world) {
        text += "; no head poses are known, and a head that turns makes eyes look slow";
    }
    return text;
}

}  // namespace

std::string smoothing_text(const gaze::SmoothingFinding& found) {
    switch (found.verdict) {
        case SmoothingVerdict::Smoothed:
            return speed_text(found) + time_constant_text(found) + what_was_looked_at(found);
        case SmoothingVerdict::NotSmoothed:
            return speed_text(found) +
                   "; a filter that takes less than a fifth of the peak would pass unseen" +
                   what_was_looked_at(found);
        case SmoothingVerdict::Unclear:
            return speed_text(found) +
                   "; some eyes are as slow as .8, so that it takes more saccades to tell" +
                   what_was_looked_at(found);
        case SmoothingVerdict::TooFewSaccades:
            return fmt::format(
                "too few saccades: {} of 2 to 30 deg stand out from the noise, "
                "{} are needed; look around for half a minute",
                found.saccades, gaze::GazeSmoothing::kFewestSaccades);
        case SmoothingVerdict::TooSlow:
            return fmt::format(
                "samples come at {:.0f} Hz; peaks of saccades need {:.0f} Hz "
                "or more",
                found.rate_hz, gaze::GazeSmoothing::kLeastRate_hz);
        case SmoothingVerdict::Repeated:
            return "most samples repeat the one before, so that speeds mean nothing: the "
                   "gaze stands still, or the tracker reports more often than it looks";
        case SmoothingVerdict::NoTimes:
            return "no sample says when the eye was seen, so that speeds are unknown";
        case SmoothingVerdict::NoSamples:
            return "no sample came";
    }
    return "";
}

}  // namespace gazeloop::report
