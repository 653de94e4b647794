#include "runtime/study/decisions.h"

namespace gazeloop::study {
namespace {

bool as_good(Design design, const Response& response) {
    const bool reference_first = response.trial.reference_first;
    switch (response.answer) {
        case Answer::Same:
            return true;
        case Answer::FirstBetter:
            return !reference_first;
        case Answer::SecondBetter:
            return reference_first;
        // A ramp that begins at the reference goes down.
        case Answer::Up:
            return design == Design::Ramp && reference_first;
        case Answer::Down:
            return design == Design::Ramp && !reference_first;
        case Answer::Different:
        case Answer::Equal:
        case Answer::Unable:
            break;
    }
    return false;
}

/// Whether a level is passed on the way to another: from the worst one on.
bool before(const Plan& plan, double level, double other) {
    return plan.higher_is_better ? level < other : level > other;
}

}  // namespace

std::vector<Decision> decisions_of(const Plan& plan, const Response& response) {
    if (!response.valid() || response.trial.kind != TrialKind::Test ||
        response.trial.levels.empty() || !answers(plan.design, response.answer)) {
        return {};
    }
    const double level = response.trial.levels.front();
    if (plan.design != Design::Slider) {
        return {{.level = level, .yes = as_good(plan.design, response)}};
    }
    std::vector<Decision> decisions;
    for (const double passed : plan.factors.front().levels) {
        if (response.answer == Answer::Unable || before(plan, passed, level)) {
            decisions.push_back({.level = passed, .yes = false});
        }
    }
    if (response.answer == Answer::Equal) {
        decisions.push_back({.level = level, .yes = true});
    }
    return decisions;
}

bool adaptive(Design design) { return design == Design::Slider || design == Design::Quest; }

bool answers(Design design, Answer answer) {
    switch (design) {
        case Design::SameDifferent:
        case Design::Quest:
            return answer == Answer::Same || answer == Answer::Different;
        case Design::Pair:
            return answer == Answer::Same || answer == Answer::FirstBetter ||
                   answer == Answer::SecondBetter;
        case Design::Ramp:
            return answer == Answer::Same || answer == Answer::Up || answer == Answer::Down;
        case Design::Slider:
            return answer == Answer::Equal || answer == Answer::Unable;
    }
    return false;
}

bool failed_validation(const Response& response) {
    return response.trial.kind == TrialKind::Validation && response.valid() &&
           response.answer != Answer::Same;
}

}  // namespace gazeloop::study
