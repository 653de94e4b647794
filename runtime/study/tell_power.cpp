#include "runtime/study/tell_power.h"

#include <nlohmann/json.hpp>
#include <span>

#include "runtime/report/output_file.h"
#include "runtime/report/summary_json.h"
#include "runtime/study/plan_file.h"
#include "runtime/study/power_report.h"

namespace gazeloop::study {

void tell_power(const PowerRequest& request, settings::Settings& known,
                const std::function<bool()>& interrupted) {
    const report::NamedFile output{"--json", request.json};
    std::vector<report::NamedFile> inputs;
    inputs.reserve(request.plans.size());
    for (const std::string& file : request.plans) {
        inputs.emplace_back("the plan", file);
    }
    value_or_throw(report::check_outputs(std::span{&output, 1}, inputs));
    std::vector<PowerOfPlan> found;
    for (const std::string& file : request.plans) {
        Plan plan = value_or_throw(read_plan(file, &known));
        const SimulatedPeople people = people_of(request.people, plan);
        if (request.minutes) {
            plan = as_long_as(plan, people, *request.minutes);
        }
        PowerOfPlan& one = found.emplace_back(plan.name, true_threshold(plan, people, 0),
                                              plan.logarithmic, std::vector<PowerRow>{});
        for (const unsigned subjects : power_steps(plan)) {
            one.rows.push_back(power_of(plan, people, subjects,
                                        {.studies = request.studies, .interrupted = interrupted}));
        }
    }
    const SimulatedPeople& people = request.people.people;
    if (request.json != "-") {
        value_or_throw(report::write_text("-", power_text(people, found)));
    }
    if (!request.json.empty()) {
        value_or_throw(
            report::write_text(request.json, report::json_text(power_json(people, found))));
    }
}

}  // namespace gazeloop::study
