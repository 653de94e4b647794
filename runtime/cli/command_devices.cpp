#include <memory>

#include "runtime/cli/commands.h"
#include "runtime/cli/run_options.h"
#include "runtime/run/devices.h"
#include "runtime/run/interrupt.h"

namespace gazeloop::cli {
namespace {

struct DevicesCommand {
    LogOptions log;
    RunOptions configured;  ///< of which --config and --set are offered
    run::DevicesRequest wanted;
};

ExitCode devices(const DevicesCommand& command) {
    run::ProgramSettings settings;
    value_or_throw(command.configured.apply_to(settings, true));
    return exit_code(run::listen_to_devices(command.wanted, settings));
}

}  // namespace

void add_devices_command(Command program) {
    Command app = program.command(
        "devices", "list eye trackers, listen to each, and say why one does not track");
    const auto command = std::make_shared<DevicesCommand>();
    command->log.add_to(app);
    app.option("--config", command->configured.config_files,
               "TOML file with settings; may be repeated")
        .type("FILE");
    app.option("--set", command->configured.assignments, "a setting; may be repeated")
        .type("KEY=VALUE");
    const Option seconds =
        app.option("--seconds", command->wanted.seconds,
                   "how long to listen to each (2), or to watch (until interrupted)")
            .type("S")
            .number_between(0.1, 1e9);
    const Option json =
        app.option("--json", command->wanted.json, "write it as JSON; without a file, to stdout")
            .file_or_stdout();
    app.flag("--watch", command->wanted.watch, "show live gaze").not_with(json);
    app.does([=] {
        command->log.apply();
        if (command->wanted.watch && !seconds.given()) {
            command->wanted.seconds = 1e9;
        }
        const run::CatchesInterrupts catches;
        return devices(*command);
    });
}

}  // namespace gazeloop::cli
