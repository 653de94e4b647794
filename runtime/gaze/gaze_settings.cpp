#include "runtime/gaze/gaze_settings.h"

#include <fmt/core.h>

#include "runtime/time/milliseconds.h"

namespace gazeloop::gaze {

std::vector<settings::SettingRow> rows_of(GazeSettings& gaze) {
    using settings::Choice;
    using settings::Concerns;
    using settings::Number;
    using settings::Path;
    constexpr double kForever_ms = 1e7;
    return {
        // Samples are recorded corrected.
        {"gaze.calibration", "the file that gazeloop calibrate made of this person and tracker",
         Path{&gaze.calibration, ""}, Concerns::Input},
        {"gaze.calibration_values", "what such a file says, as numbers with commas between",
         Choice{&gaze.calibration_values}, Concerns::Input},
        {"gaze.fixation_distance_m",
         "distance at which gaze is held in world and one ray is split between the eyes, m",
         Number{&gaze.fixation_distance_m, 0.1, 1000.0}, Concerns::Foveae},
        // Samples are recorded as split.
        {"gaze.fixation_from_depth",
         "split one ray between the eyes at the last frame's depth, where that is known",
         &gaze.fixation_from_depth, Concerns::Input},
        {"gaze.hold_ms", "lost gaze: hold the last point for this long",
         Number{&gaze.hold_ms, 0.0, kForever_ms}, Concerns::Foveae},
        {"gaze.minimum_confidence", "samples that state a lower confidence are invalid",
         Number{&gaze.minimum_confidence, 0.0, 1.0}, Concerns::Foveae},
        {"gaze.return_ms", "lost gaze: after the hold, return to straight ahead in this time",
         Number{&gaze.return_ms, 0.0, kForever_ms}, Concerns::Foveae},
        {"gaze.stale_ms", "samples older than this when the gaze is read count as lost",
         Number{&gaze.stale_ms, 0.0, kForever_ms}, Concerns::Foveae},
    };
}

FoveaPolicy fovea_policy(const GazeSettings& gaze) {
    return {.stale_ns = time::ms_to_ns(gaze.stale_ms),
            .hold_ns = time::ms_to_ns(gaze.hold_ms),
            .return_ns = time::ms_to_ns(gaze.return_ms),
            .minimum_confidence = gaze.minimum_confidence,
            .fixation_distance_m = gaze.fixation_distance_m};
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
