#include "runtime/cli/played_gaze_options.h"

#include "drivers/trace/axes_correction.h"

namespace gazeloop::cli {

void PlayedGazeOptions::add_to(Command command) {
    command.option("--trace", gaze.trace, "what it sees; without: simulated gaze").type("FILE");
    command.option("--axes", axes, "turn the trace's directions")
        .one_of({drivers::kAxesCorrectionNames.begin(), drivers::kAxesCorrectionNames.end()});
    command.flag("--accept-repairs", gaze.read.accept_repairs,
                 "read a trace of which much was dropped or changed");
    command.option("--seconds", gaze.seconds, "end after S seconds (until interrupted)")
        .number_between(0.0, 1e9);
    command.option("--rate", gaze.gaze.tracker.rate_hz, "samples per second, Hz")
        .number_between(1.0, 1e4);
    command.option("--seed", gaze.gaze.seed, "the same seed gives the same gaze");
    log.add_to(command);
}

simulate::PlayedGaze PlayedGazeOptions::played() const {
    simulate::PlayedGaze played = gaze;
    played.read.axes = drivers::axes_correction_named(axes);
    return played;
}

}  // namespace gazeloop::cli
