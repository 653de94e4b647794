#include "runtime/cli/people_options.h"

#include <fmt/core.h>

#include <charconv>

#include "runtime/study/trade_curves.h"

namespace gazeloop::cli {

void PeopleOptions::add_to(Command app) {
    app.option("--threshold", thresholds,
               "level at which a difference is just called one (the middle of the plan's); "
               "repeated: one per condition")
        .type("LEVEL");
    app.option("--width", width, "how far from there, in ln level, none is left (0.4)")
        .number_between(1e-3, 100.0);
    app.option("--trade", trade,
               "what trade --json has found for the plan's levels: people see as the contrast "
               "metric does, in place of --threshold and --width")
        .type("FILE");
    app.option("--noise", people.terms.noise, "of what is felt, in just noticeable ones (0.5)")
        .number_between(0.0, 100.0);
    app.option("--bias", people.terms.bias, "towards what came second (0)")
        .number_between(-10.0, 10.0);
    app.option("--lapse", people.terms.lapse, "share of blind answers (0.02)")
        .number_between(0.0, 1.0);
    app.option("--fatigue", people.terms.fatigue, "growth of noise and criterion per hour (0)")
        .number_between(0.0, 100.0);
    app.option("--people", people.terms.people,
               "how much people's thresholds differ, in ln level (0.1)")
        .number_between(0.0, 10.0);
    app.option("--people-seed", people.seed, "another one, other people (1)");
}

study::SimulatedPeople PeopleOptions::of(const study::Plan& plan) const {
    study::SimulatedPeople made = people;
    const std::vector<double>& levels = plan.factors.front().levels;
    if (!trade.empty()) {
        made.curves = value_or_throw(study::trade_curves(plan, trade));
        return made;
    }
    std::vector<double> at;
    for (const std::string& text : thresholds) {
        double level = 0.0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), level);
        if (error != std::errc{} || end != text.data() + text.size() ||
            !(level >= levels.front() && level <= levels.back())) {
            throw SetupError(ErrorKind::Usage,
                             fmt::format("--threshold: '{}' does not lie among the levels of "
                                         "{}, {:g} to {:g}",
                                         text, plan.name, levels.front(), levels.back()));
        }
        at.push_back(level);
    }
    if (at.empty()) {
        at.push_back(plan.level_at(0.5 * (plan.x_of(levels.front()) + plan.x_of(levels.back()))));
    }
    if (at.size() != 1 && at.size() != plan.conditions()) {
        throw SetupError(ErrorKind::Usage,
                         fmt::format("--threshold: {} of them, where {} has {} conditions",
                                     at.size(), plan.name, plan.conditions()));
    }
    for (const double level : at) {
        made.curves.push_back(study::DifferenceCurve::line(plan, level, width));
    }
    return made;
}

}  // namespace gazeloop::cli
