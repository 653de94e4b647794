#include <fmt/core.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "runtime/cli/people_options.h"
#include "runtime/cli/study_commands.h"
#include "runtime/report/output_file.h"
#include "runtime/report/summary_json.h"
#include "runtime/run/interrupt.h"
#include "runtime/study/plan_file.h"
#include "runtime/study/power_report.h"

namespace gazeloop::cli {
namespace {

struct PowerCommand {
    PeopleOptions people;
    std::vector<std::string> plans;
    unsigned studies = 100;
    std::optional<double> minutes;
    std::string json;
};

ExitCode power(const PowerCommand& command) {
    std::vector<study::PowerOfPlan> found;
    for (const std::string& file : command.plans) {
        study::Plan plan = value_or_throw(study::read_plan(file));
        const study::SimulatedPeople people = command.people.of(plan);
        if (command.minutes) {
            plan = study::as_long_as(plan, people, *command.minutes);
        }
        study::PowerOfPlan& one =
            found.emplace_back(plan.name, study::true_threshold(plan, people, 0), plan.logarithmic,
                               std::vector<study::PowerRow>{});
        for (const unsigned subjects : study::power_steps(plan)) {
            one.rows.push_back(study::power_of(
                plan, people, subjects,
                {.studies = command.studies, .interrupted = [] { return run::interrupted(); }}));
        }
    }
    if (command.json != "-") {
        fmt::print("{}", study::power_text(command.people.people, found));
    }
    if (!command.json.empty()) {
        value_or_throw(report::write_text(
            command.json, report::json_text(study::power_json(command.people.people, found))));
    }
    return run::interrupted() ? ExitCode::Interrupted : ExitCode::Ok;
}

}  // namespace

void add_study_power(Command study) {
    const auto command = std::make_shared<PowerCommand>();
    Command app = study.command("power", "how many people and minutes a design needs, simulated");
    app.option("plans", command->plans, "one or several plans").required().type("PLAN.toml...");
    app.option("--studies", command->studies, "simulated for each row (100)")
        .number_between(1, 100'000);
    app.option("--minutes", command->minutes,
               "repeat each design to about so long in the headset, to compare them")
        .number_between(1.0, 600.0);
    command->people.add_to(app);
    app.option("--json", command->json, "write the result as JSON; without a file, to stdout")
        .value_optional("-")
        .type("[FILE]");
    app.does([=] { return power(*command); });
}

}  // namespace gazeloop::cli
