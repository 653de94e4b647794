#include <memory>

#include "runtime/cli/people_options.h"
#include "runtime/cli/study_commands.h"
#include "runtime/run/interrupt.h"
#include "runtime/run/program_settings.h"
#include "runtime/study/tell_power.h"

namespace gazeloop::cli {

void add_study_power(Command parent) {
    const auto command = std::make_shared<study::PowerRequest>();
    const auto people = std::make_shared<PeopleOptions>();
    Command app = parent.command("power", "how many people and minutes a design needs, simulated");
    app.option("plans", command->plans, "one or several plans").required().type("PLAN.toml...");
    app.option("--studies", command->studies, "simulated for each row (100)")
        .number_between(1, 100'000);
    app.option("--minutes", command->minutes,
               "repeat each design to about so long in the headset, to compare them")
        .number_between(1.0, 600.0);
    people->add_to(app);
    app.option("--json", command->json, "write the result as JSON; without a file, to stdout")
        .file_or_stdout();
    app.does([=] {
        command->people = people->question;
        const run::CatchesInterrupts catches;
        run::ProgramSettings known;
        study::tell_power(*command, known, run::interrupted);
        return run::interrupted() ? ExitCode::Interrupted : ExitCode::Ok;
    });
}

}  // namespace gazeloop::cli
