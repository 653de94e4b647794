#include "runtime/study/people_question.h"

#include <fmt/core.h>

#include <charconv>

#include "runtime/study/trade_curves.h"

namespace gazeloop::study {

SimulatedPeople people_of(const PeopleQuestion& question, const Plan& plan) {
    SimulatedPeople made = question.people;
    const std::vector<double>& levels = plan.factors.front().levels;
    if (!question.trade.empty()) {
        made.curves = value_or_throw(trade_curves(plan, question.trade));
        return made;
    }
    std::vector<double> at;
    for (const std::string& text : question.thresholds) {
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
        made.curves.push_back(DifferenceCurve::line(plan, level, question.width));
    }
    return made;
}

}  // namespace gazeloop::study
