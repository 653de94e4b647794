#include <fmt/core.h>

#include <memory>

#include "runtime/cli/commands.h"
#include "runtime/cli/run_options.h"
#include "runtime/methods/registry.h"
#include "runtime/profiles/profiles_in_force.h"
#include "runtime/run/frame_run.h"
#include "runtime/run/gaze_sources.h"

namespace gazeloop::cli {
namespace {

struct RunCommand {
    RunOptions options;
    std::string gaze = "fixed:0,0";
    std::string clock = "wall";
};

ExitCode run(const RunCommand& command, const std::string& command_line) {
    run::ProgramSettings settings;
    value_or_throw(command.options.apply_to(settings, true));
    value_or_throw(run::default_tracker(command.gaze, settings));
    const profiles::TrackerProfile tracker =
        value_or_throw(profiles::simulate_tracker_in_force(settings.values().profile, settings));
    if (command.options.print_config) {
        fmt::print("{}", settings.describe());
        return ExitCode::Ok;
    }
    value_or_throw(settings.check());
    run::FrameRunRequest request;
    request.settings = &settings;
    request.command_line = command_line;
    if (command.gaze == "openxr") {
        const run::ProgramValues& values = settings.values();
        request.openxr_gaze = {.distance_m = values.gaze.fixation_distance_m,
                               .from_depth = values.gaze.fixation_from_depth &&
                                             methods::find_method(values.render.method)->uses_gaze};
    } else {
        request.make_source =
            value_or_throw(run::gaze_source_named(command.gaze, tracker, settings.values()));
    }
    request.from_device = run::is_device(command.gaze);
    request.live_gaze = request.from_device || command.gaze == "sim";
    request.clock = command.clock == "wall" ? run::RunClock::Wall : run::RunClock::Virtual;
    command.options.fill(request);
    request.loop.end_with_source = !command.options.frames && !command.options.seconds;
    return exit_code(run::frame_run(request));
}

}  // namespace

void add_run_command(Command program, const std::string& command_line) {
    Command app = program.command("run", "run the gaze-contingent frame loop");
    const auto command = std::make_shared<RunCommand>();
    app.option("--gaze", command->gaze,
               "hid, psvr2, openxr, trace:FILE, fixed:AZ,EL (degrees, right, up), or sim")
        .type("SOURCE");
    app.option("--clock", command->clock,
               "wall: in real time; virtual: the same result on every run")
        .one_of({"wall", "virtual"});
    command->options.add_to(app);
    app.does([=] {
        command->options.log.apply();
        return run(*command, command_line);
    });
}

}  // namespace gazeloop::cli
