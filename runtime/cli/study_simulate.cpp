#include <memory>
#include <span>
#include <string>

#include "runtime/cli/people_options.h"
#include "runtime/cli/study_commands.h"
#include "runtime/report/output_file.h"
#include "runtime/run/program_settings.h"
#include "runtime/study/plan_file.h"
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
    app.option("file", options->file, "where the answers go (must not hold others)")
        .required()
        .type("FILE.csv");
    app.option("--subjects", options->subjects, "how many (the plan's)").number_between(1, 10'000);
    options->people.add_to(app);
    app.does([=] {
        const report::NamedFile output{"FILE.csv", options->file};
        const report::NamedFile input{"the plan", options->plan};
        value_or_throw(report::check_outputs(std::span{&output, 1}, std::span{&input, 1}));
        run::ProgramSettings known;
        const study::Plan plan = value_or_throw(study::read_plan(options->plan, &known));
        const study::SimulatedPeople people = study::people_of(options->people.question, plan);
        const unsigned subjects = options->subjects > 0 ? options->subjects : plan.subjects;
        value_or_throw(study::write_simulated_answers(
            plan, study::simulate_study(plan, people, subjects), options->file));
        return ExitCode::Ok;
    });
}

}  // namespace gazeloop::cli
