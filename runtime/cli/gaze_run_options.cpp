#include "runtime/cli/gaze_run_options.h"

#include "runtime/run/gaze_run.h"

namespace gazeloop::cli {

void GazeRunOptions::add_to(Command command) {
    command
        .option("--gaze", gaze,
                "hid, psvr2, steam-frame[:FILE], osc:PORT, openxr, trace:FILE, fixed:AZ,EL "
                "(degrees, right, up), "
                "or sim")
        .type("SOURCE");
    command.option("--clock", clock, "wall: in real time; virtual: the same result on every run")
        .one_of({"wall", "virtual"});
    options.add_to(command);
}

std::optional<run::FrameRunRequest> GazeRunOptions::prepare(run::ProgramSettings& settings,
                                                            const std::string& command_line) const {
    value_or_throw(options.apply_to(settings, true));
    const profiles::TrackerProfile tracker = run::take_tracker(gaze, settings);
    if (options.prints(settings)) {
        return std::nullopt;
    }
    value_or_throw(settings.check());
    run::FrameRunRequest request = run::gaze_run(
        gaze, clock == "wall" ? run::RunClock::Wall : run::RunClock::Virtual, tracker, settings);
    request.command_line = command_line;
    options.fill(request);
    request.loop.end_with_source = !options.frames && !options.seconds;
    return request;
}

}  // namespace gazeloop::cli
