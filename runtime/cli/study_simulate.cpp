#include <memory>
#include <string>

#include "runtime/cli/people_options.h"
#include "runtime/cli/study_commands.h"
#include "runtime/study/plan_file.h"
#include "runtime/study/responses_file.h"
#include "runtime/study/study_files.h"

namespace gazeloop::cli {

void add_study_simulate(Command study) {
    struct Options {
        PeopleOptions people;
        std::string plan;
        std::string file;
        unsigned subjects = 0;
    };
    const auto options = std::make_shared<Options>();
    Command app = study.command("simulate", "answers of simulated people, for study analyse");
    app.option("plan", options->plan, "the study's plan").required().type("PLAN.toml");
    app.option("file", options->file, "where the answers go").required().type("FILE.csv");
    app.option("--subjects", options->subjects, "how many (the plan's)").number_between(1, 10'000);
    options->people.add_to(app);
    app.does([=] {
        const study::Plan plan = value_or_throw(study::read_plan(options->plan));
        const study::SimulatedPeople people = study::people_of(options->people.question, plan);
        value_or_throw(study::write_private(
            options->file, study::responses_csv(plan, study::simulate_study(plan, people,
                                                                            options->subjects > 0
                                                                                ? options->subjects
                                                                                : plan.subjects))));
        return ExitCode::Ok;
    });
}

}  // namespace gazeloop::cli
