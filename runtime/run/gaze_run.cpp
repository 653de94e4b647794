#include "runtime/run/gaze_run.h"

#include <spdlog/spdlog.h>

#include <string_view>

#include "runtime/methods/registry.h"
#include "runtime/profiles/profiles_in_force.h"
#include "runtime/run/gaze_sources.h"

namespace gazeloop::run {
namespace {

/// A calibration holds for the tracker that it was made with. What a trace was recorded with, only
/// its user knows.
void warn_of_other_device(std::string_view made_with, std::string_view gaze) {
    const auto source = [](std::string_view text) { return text.substr(0, text.find(':')); };
    if (!made_with.empty() && source(gaze) != "trace" && source(gaze) != "fixed" &&
        source(made_with) != source(gaze)) {
        spdlog::warn(
            "gaze.calibration was made with --gaze {} and corrects --gaze {} now: calibrate "
            "this tracker (gazeloop calibrate --gaze {}), or leave the calibration out",
            made_with, gaze, gaze);
    }
}

}  // namespace

profiles::TrackerProfile take_tracker(const std::string& gaze, ProgramSettings& settings) {
    value_or_throw(default_tracker(gaze, settings));
    profiles::TrackerProfile tracker =
        value_or_throw(profiles::simulate_tracker_in_force(settings.values().profile, settings));
    value_or_throw(default_widening(tracker, settings));
    return tracker;
}

FrameRunRequest gaze_run(const std::string& gaze, RunClock clock,
                         const profiles::TrackerProfile& tracker, const ProgramSettings& settings) {
    warn_of_other_device(settings.values().gaze.calibration_device, gaze);
    FrameRunRequest request;
    request.settings = &settings;
    if (gaze == "openxr") {
        const ProgramValues& values = settings.values();
        request.openxr_gaze = {.distance_m = values.gaze.fixation_distance_m,
                               .from_depth = values.gaze.fixation_from_depth &&
                                             methods::find_method(values.render.method)->uses_gaze};
    } else {
        request.make_source = value_or_throw(gaze_source_named(gaze, tracker, settings.values()));
    }
    request.gaze = gaze;
    request.from_device = is_device(gaze);
    request.live_gaze = request.from_device || gaze == "sim";
    request.clock = clock;
    constexpr std::string_view kTrace = "trace:";
    if (gaze.starts_with(kTrace)) {
        request.reads_trace = true;
        request.reads.push_back({"--gaze", gaze.substr(kTrace.size())});
    }
    if (const std::filesystem::path scene = settings.values().render.scene; scene.has_extension()) {
        request.reads.push_back({"--scene", scene});
    }
    return request;
}

}  // namespace gazeloop::run
