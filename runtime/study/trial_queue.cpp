#include "runtime/study/trial_queue.h"

#include <fmt/core.h>

#include <algorithm>

#include "runtime/study/decisions.h"
#include "runtime/study/trial_order.h"

namespace gazeloop::study {
namespace {

std::unexpected<Error> other_plan(const Response& response, std::string_view why) {
    return std::unexpected(
        Error{ErrorKind::BadInput,
              fmt::format("the recorded answer to trial {} of subject {} {}: it belongs to another "
                          "plan, or is damaged; use the plan with which the study was begun",
                          response.trial.number, response.subject, why)});
}

/// Whether what was shown is what the plan has for this trial; a slider's level is the answer.
bool same_trial(const Plan& plan, Trial planned, Trial shown) {
    if (plan.design == Design::Slider && planned.kind != TrialKind::Validation &&
        planned.levels.size() == shown.levels.size()) {
        planned.levels.front() = shown.levels.front() = 0.0;
    }
    return planned == shown;
}

}  // namespace

TrialQueue::TrialQueue(const Plan& plan, unsigned subject) : plan_(&plan), subject_(subject) {
    for (Trial& trial : trials_of(plan, subject)) {
        trials_.push_back(std::move(trial));
    }
    decide();
}

unsigned TrialQueue::attempt() const {
    const auto found = attempts_.find(now_.number);
    return found == attempts_.end() ? 0 : found->second;
}

QuestPlus& TrialQueue::staircase(const Trial& trial) {
    const std::vector<double> condition(trial.levels.begin() + 1, trial.levels.end());
    const auto found = staircases_.find(condition);
    if (found != staircases_.end()) {
        return found->second;
    }
    std::vector<double> stimuli;
    for (const double level : plan_->factors.front().levels) {
        stimuli.push_back(plan_->x_of(level));
    }
    return staircases_
        .emplace(condition, QuestPlus(QuestGrid::over(stimuli, plan_->higher_is_better)))
        .first->second;
}

void TrialQueue::decide() {
    if (trials_.empty()) {
        return;
    }
    now_ = trials_.front();
    if (plan_->design == Design::Quest && now_.kind != TrialKind::Validation) {
        // Of the plan's levels the nearest: the axis is only near to them.
        const Factor& factor = plan_->factors.front();
        const double level = plan_->level_at(staircase(now_).next());
        now_.levels.front() = factor.levels[factor.index_of(level)];
    }
}

Rest TrialQueue::answered(const Response& response) {
    const Trial planned = trials_.front();
    trials_.pop_front();
    if (!response.valid()) {
        if (++attempts_[planned.number] < plan_->gaze.most_attempts) {
            // At its session's end.
            const auto end = std::ranges::find_if(
                trials_, [&](const Trial& trial) { return trial.session > planned.session; });
            trials_.insert(end, planned);
        } else {
            ++given_up_;
        }
    }
    if (plan_->design == Design::Quest) {
        for (const Decision& decision : decisions_of(*plan_, response)) {
            staircase(planned).answer(plan_->x_of(decision.level), decision.yes);
        }
    }
    decide();
    if (trials_.empty()) {
        return Rest::None;
    }
    if (trials_.front().session != planned.session) {
        return Rest::SessionOver;
    }
    return failed_validation(response) ? Rest::FailedValidation : Rest::None;
}

Expected<void> TrialQueue::resume(std::span<const Response> responses) {
    for (const Response& response : responses) {
        if (next() == nullptr) {
            return other_plan(response, "comes after the study's end");
        }
        if (response.subject != subject_) {
            return other_plan(response, fmt::format("is not subject {}'s", subject_));
        }
        if (response.attempt != attempt() || !same_trial(*plan_, now_, response.trial)) {
            return other_plan(response,
                              fmt::format("stands where the plan has trial {}", now_.number));
        }
        if (!answers(plan_->design, response.answer)) {
            return other_plan(response,
                              fmt::format("is '{}', which the design does not have",
                                          kAnswerNames[static_cast<std::size_t>(response.answer)]));
        }
        answered(response);
    }
    return {};
}

}  // namespace gazeloop::study
