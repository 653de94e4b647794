#include <memory>
#include <utility>

#include "runtime/cli/commands.h"
#include "runtime/cli/run_options.h"
#include "runtime/run/examination.h"
#include "runtime/run/interrupt.h"

namespace gazeloop::cli {
namespace {

struct DoctorCommand {
    RunOptions options;  ///< of which those of the settings are offered
    run::Examination wanted;
};

ExitCode examine(const DoctorCommand& command) {
    run::ProgramSettings settings;
    doctor::Findings findings = run::check_configuration(command.options.config_files, settings);
    // The files are loaded already, as far as they can be.
    RunOptions rest = command.options;
    rest.config_files.clear();
    value_or_throw(rest.set_in(settings, false));
    return exit_code(run::examine(command.wanted, settings, std::move(findings)));
}

}  // namespace

void add_doctor_command(Command program) {
    Command app = program.command(
        "doctor", "check what the loop needs of this machine; exit code 4: it cannot run");
    const auto command = std::make_shared<DoctorCommand>();
    app.option("--json", command->wanted.json, "write it as JSON; without a file, to stdout")
        .file_or_stdout();
    command->options.log.add_to(app);
    command->options.add_settings_to(app);
    app.option("--folder", command->wanted.folder, "where recordings are to go").type("DIR");
    app.option("--patience", command->wanted.patience_s,
               "how long a driver or runtime may take before it counts as hanging")
        .type("SECONDS")
        .number_between(0.1, 600.0);
    // Stands in for the machine's /sys and /dev, for tests.
    app.option("--root", command->wanted.root, "").hidden();
    app.does([=] {
        command->options.log.apply();
        const run::CatchesInterrupts catches;
        return examine(*command);
    });
}

}  // namespace gazeloop::cli
