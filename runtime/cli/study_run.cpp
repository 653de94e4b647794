#include <memory>

#include "runtime/cli/gaze_run_options.h"
#include "runtime/cli/people_options.h"
#include "runtime/cli/study_commands.h"
#include "runtime/run/study_sitting.h"

namespace gazeloop::cli {
namespace {

struct StudyRunCommand {
    GazeRunOptions run;
    PeopleOptions people;
    run::StudySitting sitting;
    bool simulated = false;
};

ExitCode study_run(const StudyRunCommand& command, const std::string& command_line) {
    run::ProgramSettings settings;
    auto request = command.run.prepare(settings, command_line);
    if (!request) {
        return ExitCode::Ok;
    }
    run::StudySitting sitting = command.sitting;
    sitting.quiet = command.run.options.log.quiet;
    if (command.simulated) {
        sitting.simulated = command.people.question;
    }
    return exit_code(run::run_sitting(sitting, settings, *request));
}

}  // namespace

void add_study_run(Command study, const std::string& command_line) {
    Command app =
        study.command("run", "show a study's trials to one subject; goes on where it was");
    const auto command = std::make_shared<StudyRunCommand>();
    app.option("plan", command->sitting.plan, "the study's plan").required().type("PLAN.toml");
    app.option("--subject", command->sitting.subject, "whose number; no names")
        .required()
        .number_between(1, 1e6);
    app.option("--folder", command->sitting.folder, "where sittings are recorded (study)")
        .type("DIR");
    app.flag("--simulated", command->simulated, "a simulated person answers (study power --help)");
    command->run.add_to(app);
    command->people.add_to(app);
    app.does([=] {
        command->run.options.log.apply();
        return study_run(*command, command_line);
    });
}

}  // namespace gazeloop::cli
