#include <memory>
#include <utility>

#include "runtime/cli/commands.h"
#include "runtime/cli/gaze_run_options.h"
#include "runtime/run/calibration_run.h"

namespace gazeloop::cli {
namespace {

struct CalibrateCommand {
    GazeRunOptions run;
    run::CalibrationRun wanted;
};

ExitCode calibrate(const CalibrateCommand& command, const std::string& command_line) {
    run::ProgramSettings settings;
    auto request = command.run.prepare(settings, command_line);
    if (!request) {
        return ExitCode::Ok;
    }
    run::CalibrationRun wanted = command.wanted;
    wanted.gaze = command.run.gaze;
    wanted.json = command.run.options.json;
    wanted.quiet = command.run.options.log.quiet;
    return exit_code(run::calibration_run(wanted, std::move(*request), settings));
}

}  // namespace

void add_calibrate_command(Command program, const std::string& command_line) {
    Command app = program.command(
        "calibrate", "correct a tracker for one person: nine points to look at, a fit per eye");
    const auto command = std::make_shared<CalibrateCommand>();
    command->run.gaze = "hid";
    command->run.add_to(app);
    app.option("--user", command->wanted.user, "whose eyes they are (who is logged in)")
        .type("NAME");
    app.option("--out", command->wanted.out,
               "where the calibration goes (USER.SOURCE.toml in the user's data folder)")
        .type("FILE");
    app.option("--point-seconds", command->wanted.schedule.shown_s,
               "how long each point is shown (1.6)")
        .type("S")
        .number_between(0.9, 60.0);
    app.option("--half-width", command->wanted.schedule.half_width_deg,
               "how far to the side the outer points lie, deg (15)")
        .type("DEG")
        .number_between(2.0, 45.0);
    app.option("--half-height", command->wanted.schedule.half_height_deg,
               "how far up and down the outer points lie, deg (10)")
        .type("DEG")
        .number_between(2.0, 45.0);
    app.option("--bad-point", command->wanted.bad_point,
               "with --gaze sim: look 8 deg beside this point, 1 to 9")
        .type("N")
        .number_between(1.0, 9.0);
    app.does([=] {
        command->run.options.log.apply();
        return calibrate(*command, command_line);
    });
}

}  // namespace gazeloop::cli
