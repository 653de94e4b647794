#include "runtime/gaze/gaze_settings.h"

#include <fmt/core.h>

#include <algorithm>
#include <glm/trigonometric.hpp>
#include <string_view>

#include "runtime/time/milliseconds.h"

namespace gazeloop::gaze {
namespace {

constexpr std::string_view kReturn = "return";
constexpr std::string_view kStay = "stay";
constexpr std::string_view kByAge = "age";
constexpr std::string_view kByEvents = "events";

UncertaintyPolicy uncertainty_policy(const GazeSettings& gaze) {
    return {.median_error_deg = gaze.widen_error_deg,
            .noise_deg = gaze.widen_noise_deg,
            .pursuit_deg_per_s = gaze.widen_pursuit_deg_per_s,
            .head_deg_per_s = gaze.widen_head_deg_per_s,
            .lost_deg_per_s = gaze.widen_lost_deg_per_s,
            .greatest_deg = gaze.widen_most_deg,
            .by_events = gaze.widen_by == kByEvents,
            .suppressed_before_landing_s =
                gaze.widen_suppressed ? std::optional(1e-3 * gaze.widen_suppressed_margin_ms)
                                      : std::nullopt};
}

}  // namespace

std::vector<settings::SettingRow> rows_of(GazeSettings& gaze) {
    using settings::Choice;
    using settings::Concerns;
    using settings::Number;
    using settings::Path;
    constexpr double kForever_ms = 1e7;
    const settings::OnlyWhile one_euro{.key = "gaze.filter",
                                       .values = {std::string(name(GazeFilter::OneEuro))}};
    const settings::OnlyWhile fixation{.key = "gaze.filter",
                                       .values = {std::string(name(GazeFilter::Fixation))}};
    const settings::OnlyWhile by_events{.key = "gaze.widen_by", .values = {std::string(kByEvents)}};
    const settings::OnlyWhile widening{.key = "gaze.widen", .values = {"true"}};
    const settings::OnlyWhile predicting{.key = "gaze.prediction", .values = {"true"}};
    return {
        {"gaze.after_hold", "lost gaze: after the hold, return to straight ahead, or stay",
         Choice{&gaze.after_hold, {std::string(kReturn), std::string(kStay)}}, Concerns::Foveae},
        {"gaze.blink_hold_ms", "a blink (gaze.closed_below): hold the last point for this long",
         Number{&gaze.blink_hold_ms, 0.0, kForever_ms}, Concerns::Foveae},
        // Samples are recorded corrected.
        {"gaze.calibration", "the file that gazeloop calibrate made of this person and tracker",
         Path{&gaze.calibration, ""}, Concerns::Input},
        {"gaze.calibration_device",
         "the source that this calibration was made with, as --gaze has it",
         Choice{&gaze.calibration_device}, Concerns::Input},
        {"gaze.calibration_values", "what such a file says, as numbers with commas between",
         Choice{&gaze.calibration_values}, Concerns::Input},
        {"gaze.closed_below",
         "an eye that is stated to be less open than this is shut, 0 to 1; 0: openness counts for "
         "nothing",
         Number{&gaze.closed_below, 0.0, 1.0}, Concerns::Foveae},
        {"gaze.events", "record what the eyes do, also without filter and prediction", &gaze.events,
         Concerns::Foveae},
        {"gaze.field_deg", "gaze farther than this from straight ahead is taken for an error",
         Number{&gaze.field_deg, 1.0, 180.0}, Concerns::Foveae},
        {"gaze.filter",
         "filter of the gaze that foveae rest on: one-euro, or fixation, which filters nothing "
         "else",
         Choice{.value = &gaze.filter, .names = {kGazeFilterNames.begin(), kGazeFilterNames.end()}},
         Concerns::Foveae},
        {"gaze.filter_memory_ms", "the filter fixation averages over about this long",
         Number{&gaze.filter_memory_ms, 1.0, 1000.0}, Concerns::Foveae, fixation},
        {"gaze.fixation_distance_m",
         "distance at which gaze is held in world and one ray is split between the eyes, m",
         Number{&gaze.fixation_distance_m, 0.1, 1000.0}, Concerns::Foveae},
        // Samples are recorded as split.
        {"gaze.fixation_from_depth",
         "split one ray between the eyes at the last frame's depth, where that is known",
         &gaze.fixation_from_depth, Concerns::Input},
        {"gaze.hold_ms", "lost gaze: hold the last point for this long",
         Number{&gaze.hold_ms, 0.0, kForever_ms}, Concerns::Foveae},
        {"gaze.longest_prediction_ms", "gaze is predicted no further than this",
         Number{&gaze.longest_prediction_ms, 0.0, 200.0}, Concerns::Foveae, predicting},
        {"gaze.minimum_confidence", "samples that state a lower confidence are invalid",
         Number{&gaze.minimum_confidence, 0.0, 1.0}, Concerns::Foveae},
        {"gaze.one_euro_hz_per_deg_per_s",
         "the filter one-euro's cut-off rises by this with the speed, Hz per deg/s",
         Number{&gaze.one_euro_hz_per_deg_per_s, 0.0, 100.0}, Concerns::Foveae, one_euro},
        {"gaze.one_euro_least_hz", "the filter one-euro's cut-off for a resting gaze, Hz",
         Number{&gaze.one_euro_least_hz, 0.01, 1000.0}, Concerns::Foveae, one_euro},
        {"gaze.prediction", "predict the gaze to the time at which the frame is shown",
         &gaze.prediction, Concerns::Foveae},
        {"gaze.reopen_ms", "after a blink (gaze.closed_below), use no sample for this long",
         Number{&gaze.reopen_ms, 0.0, 1000.0}, Concerns::Foveae},
        {"gaze.return_ms", "lost gaze: after the hold, return to straight ahead in this time",
         Number{&gaze.return_ms, 0.0, kForever_ms}, Concerns::Foveae},
        {"gaze.stale_ms", "samples older than this when the gaze is read count as lost",
         Number{&gaze.stale_ms, 0.0, kForever_ms}, Concerns::Foveae},
        {"gaze.unplugged_hold_ms", "a tracker that is gone: hold the last point for this long",
         Number{&gaze.unplugged_hold_ms, 0.0, kForever_ms}, Concerns::Foveae},
        {"gaze.widen", "widen the fovea by how uncertain it is where the eye looks", &gaze.widen,
         Concerns::Foveae},
        {"gaze.widen_by",
         "gaze.widen: by the age of the gaze alone, or by what the eyes are seen to do",
         Choice{&gaze.widen_by, {std::string(kByAge), std::string(kByEvents)}}, Concerns::Foveae,
         widening},
        {"gaze.widen_error_deg", "gaze.widen: the tracker's median error, deg",
         Number{&gaze.widen_error_deg, 0.0, 45.0}, Concerns::Foveae, widening},
        {"gaze.widen_head_deg_per_s",
         "gaze.widen: speed of the head where its pose is not known, deg/s",
         Number{&gaze.widen_head_deg_per_s, 0.0, 1000.0}, Concerns::Foveae, widening},
        {"gaze.widen_lost_deg_per_s", "gaze.widen: by how much per second of lost gaze, deg/s",
         Number{&gaze.widen_lost_deg_per_s, 0.0, 1000.0}, Concerns::Foveae, widening},
        {"gaze.widen_most_deg", "gaze.widen: by no more than this, deg",
         Number{&gaze.widen_most_deg, 0.0, 80.0}, Concerns::Foveae, widening},
        {"gaze.widen_noise_deg",
         "gaze.widen: the tracker's noise (SD) where no sample states a covariance, deg",
         Number{&gaze.widen_noise_deg, 0.0, 45.0}, Concerns::Foveae, widening},
        {"gaze.widen_pursuit_deg_per_s",
         "gaze.widen: speed of an eye that follows something, deg/s",
         Number{&gaze.widen_pursuit_deg_per_s, 0.0, 1000.0}, Concerns::Foveae, widening},
        {"gaze.widen_suppressed",
         "gaze.widen: not in frames that are shown in the midst of a saccade",
         &gaze.widen_suppressed, Concerns::Foveae, by_events},
        {"gaze.widen_suppressed_margin_ms",
         "gaze.widen_suppressed: widened again so long before the landing",
         Number{&gaze.widen_suppressed_margin_ms, 0.0, 100.0}, Concerns::Foveae, by_events},
    };
}

FoveaPolicy fovea_policy(const GazeSettings& gaze) {
    const auto filter = std::ranges::find(kGazeFilterNames, gaze.filter);
    const MotionPolicy motion{
        .tell_events = gaze.events,
        .filter = static_cast<GazeFilter>(filter - kGazeFilterNames.begin()),
        .one_euro = {.least_cutoff_hz = gaze.one_euro_least_hz,
                     .cutoff_hz_per_deg_per_s = gaze.one_euro_hz_per_deg_per_s},
        .fixation = {.memory_s = 1e-3 * gaze.filter_memory_ms},
        .predict = gaze.prediction,
        .longest_prediction_ns = time::ms_to_ns(gaze.longest_prediction_ms)};
    return {.loss = {.stale_ns = time::ms_to_ns(gaze.stale_ms),
                     .hold_ns = time::ms_to_ns(gaze.hold_ms),
                     .return_ns = time::ms_to_ns(gaze.return_ms),
                     .minimum_confidence = gaze.minimum_confidence,
                     .blink_hold_ns = time::ms_to_ns(gaze.blink_hold_ms),
                     .unplugged_hold_ns = time::ms_to_ns(gaze.unplugged_hold_ms),
                     .reopen_ns = time::ms_to_ns(gaze.reopen_ms),
                     .closed_below = gaze.closed_below,
                     .field_rad = glm::radians(gaze.field_deg),
                     .hold_for_ever = gaze.after_hold == kStay},
            .fixation_distance_m = gaze.fixation_distance_m,
            .uncertainty = gaze.widen ? std::optional(uncertainty_policy(gaze)) : std::nullopt,
            .motion = motion};
}

Expected<void> check(const GazeSettings& gaze, const settings::Settings& all) {
    // Gaze that stops coming counts as lost only when it is stale. If its hold time were over by
    // then, the fovea's return would begin in the middle.
    if (gaze.hold_ms < gaze.stale_ms) {
        return std::unexpected(
            Error{ErrorKind::Usage,
                  fmt::format("{}: is less than {}: the fovea would jump when gaze stops coming; "
                              "set gaze.hold_ms to {} or more, or gaze.stale_ms to {} or less",
                              all.with_origin("gaze.hold_ms"), all.with_origin("gaze.stale_ms"),
                              gaze.stale_ms, gaze.hold_ms)});
    }
    return {};
}

}  // namespace gazeloop::gaze
