#include <fmt/core.h>

#include <memory>

#include "runtime/cli/commands.h"
#include "runtime/cli/run_options.h"
#include "runtime/profiles/profiles_in_force.h"
#include "runtime/simulate/gaze_file.h"

namespace gazeloop::cli {
namespace {

struct SimulateGazeCommand {
    RunOptions options;  // of which only the settings are used
    std::string file;
    double seconds = 60.0;
};

ExitCode simulate_gaze(const SimulateGazeCommand& command) {
    run::ProgramSettings settings;
    value_or_throw(command.options.apply_to(settings, true));
    value_or_throw(profiles::simulate_tracker_in_force(settings.values().profile, settings));
    if (command.options.prints(settings)) {
        return ExitCode::Ok;
    }
    const sim::GazeSimulation& simulation = settings.values().sim;
    const std::size_t samples = simulate::write_gaze_file(simulation, command.seconds, command.file,
                                                          report::files_of(settings));
    if (!command.options.log.quiet) {
        fmt::print("{}: {} samples, {} s at {} Hz, seed {}\n", command.file, samples,
                   command.seconds, simulation.tracker.rate_hz, simulation.seed);
    }
    return ExitCode::Ok;
}

}  // namespace

void add_simulate_gaze_command(Command simulate) {
    Command gaze = simulate.command("gaze", "write a trace of simulated gaze");
    const auto command = std::make_shared<SimulateGazeCommand>();
    gaze.option("file", command->file, "the trace to write (overwritten)").required().type("OUT");
    gaze.option("--seconds", command->seconds, "length").number_between(1e-3, 1e5);
    command->options.aliases = {
        {"--rate", "sim.rate_hz", "samples per second, 1 to 10000"},
        {"--seed", "sim.seed", "the same seed gives the same trace"},
        {"--tracker", "profile.tracker", "tracker profile, by name or .toml file"},
    };
    command->options.switches.clear();
    command->options.log.add_to(gaze);
    command->options.add_settings_to(gaze);
    gaze.does([=] {
        command->options.log.apply();
        return simulate_gaze(*command);
    });
}

}  // namespace gazeloop::cli
