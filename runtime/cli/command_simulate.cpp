#include <fmt/core.h>

#include <memory>

#include "drivers/trace/native_trace.h"
#include "runtime/cli/commands.h"
#include "runtime/cli/run_options.h"
#include "sim/gaze_generator.h"

namespace gazeloop::cli {
namespace {

struct SimulateGazeCommand {
    LogOptions log;
    std::string file;
    sim::GazeGeneratorConfig config;
};

ExitCode simulate_gaze(const SimulateGazeCommand& command) {
    const drivers::Trace trace = sim::generate_gaze(command.config);
    value_or_throw(drivers::write_native_trace(trace, command.file));
    if (!command.log.quiet) {
        fmt::print("{}: {} samples, {} s at {} Hz, seed {}\n", command.file, trace.samples.size(),
                   command.config.seconds, command.config.rate_hz, command.config.seed);
    }
    return ExitCode::Ok;
}

}  // namespace

void add_simulate_command(CLI::App& program, Action& action) {
    CLI::App* const app = program.add_subcommand("simulate", "make input without a device");
    app->require_subcommand(1);
    CLI::App* const gaze = app->add_subcommand("gaze", "write a trace of simulated gaze");
    const auto command = std::make_shared<SimulateGazeCommand>();
    gaze->add_option("file", command->file, "the trace to write (overwritten)")
        ->required()
        ->type_name("OUT");
    gaze->add_option("--seconds", command->config.seconds, "length")
        ->check(number_between(1e-3, 1e5));
    gaze->add_option("--rate", command->config.rate_hz, "samples a second, Hz")
        ->check(number_between(1.0, 1e4));
    gaze->add_option("--seed", command->config.seed, "the same seed gives the same trace");
    command->log.add_to(*gaze);
    gaze->callback([=, &action] {
        command->log.apply();
        action = [=] { return simulate_gaze(*command); };
    });
}

}  // namespace gazeloop::cli
