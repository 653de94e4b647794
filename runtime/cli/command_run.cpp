#include <memory>

#include "runtime/cli/commands.h"
#include "runtime/cli/gaze_run_options.h"
#include "runtime/run/govern.h"

namespace gazeloop::cli {
namespace {

ExitCode run(const GazeRunOptions& options, const std::string& command_line) {
    run::ProgramSettings settings;
    auto request = options.prepare(settings, command_line);
    if (!request) {
        return ExitCode::Ok;
    }
    const auto governed = run::govern(settings, *request);
    return exit_code(run::frame_run(*request));
}

}  // namespace

void add_run_command(Command program, const std::string& command_line) {
    Command app = program.command("run", "run the gaze-contingent frame loop");
    const auto options = std::make_shared<GazeRunOptions>();
    options->add_to(app);
    app.does([=] {
        options->options.log.apply();
        return run(*options, command_line);
    });
}

}  // namespace gazeloop::cli
