#include "runtime/cli/gaze_run_options.h"

#include <fmt/core.h>

#include "runtime/methods/registry.h"
#include "runtime/profiles/profiles_in_force.h"
#include "runtime/run/gaze_sources.h"

namespace gazeloop::cli {

void GazeRunOptions::add_to(Command command) {
    command
        .option(
            "--gaze", gaze,
            "hid, psvr2, steam-frame[:FILE], openxr, trace:FILE, fixed:AZ,EL (degrees, right, up), "
            "or sim")
        .type("SOURCE");
    command.option("--clock", clock, "wall: in real time; virtual: the same result on every run")
        .one_of({"wall", "virtual"});
    options.add_to(command);
}

std::optional<run::FrameRunRequest> GazeRunOptions::prepare(run::ProgramSettings& settings,
                                                            const std::string& command_line) const {
    value_or_throw(options.apply_to(settings, true));
    value_or_throw(run::default_tracker(gaze, settings));
    const profiles::TrackerProfile tracker =
        value_or_throw(profiles::simulate_tracker_in_force(settings.values().profile, settings));
    value_or_throw(run::default_widening(tracker, settings));
    if (options.print_config) {
        fmt::print("{}", settings.describe());
        return std::nullopt;
    }
    value_or_throw(settings.check());
    run::FrameRunRequest request;
    request.settings = &settings;
    request.command_line = command_line;
    if (gaze == "openxr") {
        const run::ProgramValues& values = settings.values();
        request.openxr_gaze = {.distance_m = values.gaze.fixation_distance_m,
                               .from_depth = values.gaze.fixation_from_depth &&
                                             methods::find_method(values.render.method)->uses_gaze};
    } else {
        request.make_source =
            value_or_throw(run::gaze_source_named(gaze, tracker, settings.values()));
    }
    request.from_device = run::is_device(gaze);
    request.live_gaze = request.from_device || gaze == "sim";
    request.clock = clock == "wall" ? run::RunClock::Wall : run::RunClock::Virtual;
    options.fill(request);
    constexpr std::string_view kTrace = "trace:";
    if (gaze.starts_with(kTrace)) {
        request.reads.push_back({"--gaze", gaze.substr(kTrace.size())});
    }
    if (const std::filesystem::path scene = settings.values().render.scene; scene.has_extension()) {
        request.reads.push_back({"--scene", scene});
    }
    request.loop.end_with_source = !options.frames && !options.seconds;
    return request;
}

}  // namespace gazeloop::cli
