#include "runtime/study/study_run.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <string>

#include "runtime/cli/gaze_run_options.h"
#include "runtime/cli/people_options.h"
#include "runtime/cli/study_commands.h"
#include "runtime/run/study_request.h"
#include "runtime/study/plan_file.h"
#include "runtime/study/sittings.h"

namespace gazeloop::cli {
namespace {

struct StudyRunCommand {
    GazeRunOptions run;
    PeopleOptions people;
    std::string plan;
    std::string folder = "study";
    unsigned subject = 0;
    bool simulated = false;
};

ExitCode study_run(const StudyRunCommand& command, const std::string& command_line) {
    run::ProgramSettings settings;
    auto request = command.run.prepare(settings, command_line);
    if (!request) {
        return ExitCode::Ok;
    }
    if (request->record) {
        throw SetupError(ErrorKind::Usage,
                         "study run: every sitting is recorded in --folder: leave out --record");
    }
    const study::Plan plan = value_or_throw(study::read_plan(command.plan));
    value_or_throw(run::take_plan(plan, settings));
    study::TrialQueue queue(plan, command.subject);
    const study::Sittings sittings =
        value_or_throw(study::find_sittings(plan, command.subject, command.folder));
    value_or_throw(queue.resume(sittings.responses));
    if (queue.next() == nullptr) {
        fmt::print("subject {} has answered all of {}\n", command.subject, plan.name);
        return ExitCode::Ok;
    }
    study::SimulatedPeople people;
    if (command.simulated) {
        people = command.people.of(plan);
    }
    const auto input = command.simulated ? study::simulated_input(plan, people, command.subject)
                                         : study::keyboard_input(plan.design);
    study::StudyRun study(plan, queue, command.subject, *input,
                          [](const std::string& line) { fmt::print(stderr, "{}\n", line); });
    run::show_study(study, settings, *request);
    request->record = sittings.next;
    if (!command.run.options.log.quiet) {
        fmt::print(stderr, "{}: subject {}, {} trials left; {}\n", plan.name, command.subject,
                   queue.left(), study::keys_text(plan.design));
    }
    const auto failure = run::frame_run(*request);
    fmt::print(stderr, "{} answers, {} trials left; recorded to {}\n", study.answers(),
               queue.left(), sittings.next.string());
    if (study.too_slow()) {
        throw SetupError(ErrorKind::NoDevice,
                         "this machine is too slow for the plan's times: pictures were over before "
                         "they were drawn; use a smaller picture (--set render.scale=0.3)");
    }
    return exit_code(failure);
}

}  // namespace

void add_study_run(Command study, const std::string& command_line) {
    Command app =
        study.command("run", "show a study's trials to one subject; goes on where it was");
    const auto command = std::make_shared<StudyRunCommand>();
    app.option("plan", command->plan, "the study's plan").required().type("PLAN.toml");
    app.option("--subject", command->subject, "whose number; no names")
        .required()
        .number_between(1, 1e6);
    app.option("--folder", command->folder, "where sittings are recorded (study)").type("DIR");
    app.flag("--simulated", command->simulated, "a simulated person answers (study power --help)");
    command->run.add_to(app);
    command->people.add_to(app);
    app.does([=] {
        command->run.options.log.apply();
        return study_run(*command, command_line);
    });
}

}  // namespace gazeloop::cli
