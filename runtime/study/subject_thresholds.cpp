#include "runtime/study/subject_thresholds.h"

#include <map>

#include "runtime/study/decisions.h"

namespace gazeloop::study {
namespace {

struct Count {
    unsigned trials = 0;
    unsigned yes = 0;
};

}  // namespace

std::size_t condition_of(const Plan& plan, const Trial& trial) {
    std::size_t condition = 0;
    for (std::size_t at = 1; at < trial.levels.size(); ++at) {
        condition = condition * plan.factors[at].levels.size() +
                    plan.factors[at].index_of(trial.levels[at]);
    }
    return condition;
}

std::optional<double> subject_threshold(const Plan& plan, std::span<const Response> of_subject,
                                        std::size_t condition) {
    std::map<double, Count> by_level;
    double stops = 0.0;
    unsigned stopped = 0;
    for (const Response& response : of_subject) {
        const std::vector<Decision> decisions = decisions_of(plan, response);
        if (decisions.empty() || condition_of(plan, response.trial) != condition) {
            continue;
        }
        if (response.answer == Answer::Equal) {
            stops += decisions.back().level;
            ++stopped;
        }
        for (const Decision& decision : decisions) {
            Count& count = by_level[decision.level];
            ++count.trials;
            count.yes += decision.yes ? 1 : 0;
        }
    }
    if (plan.design == Design::Slider) {
        return stopped > 0 ? std::optional(stops / stopped) : std::nullopt;
    }
    const bool any = plan.design == Design::Pair || plan.design == Design::Ramp;
    std::optional<double> furthest;
    for (const auto& [level, count] : by_level) {
        const bool yes = any ? count.yes > 0 : count.yes >= plan.criterion * count.trials;
        // From the lowest level up: of a quality the first one is furthest, else the last one.
        if (yes && (!plan.higher_is_better || !furthest)) {
            furthest = level;
        }
    }
    return furthest;
}

}  // namespace gazeloop::study
