#pragma once

#include <deque>
#include <map>
#include <span>
#include <vector>

#include "runtime/study/plan.h"
#include "runtime/study/quest_plus.h"
#include "runtime/study/trial.h"

namespace gazeloop::study {

/// Why a subject rests now.
enum class Rest : std::uint8_t { None, FailedValidation, SessionOver };

/// Which trial comes next for one subject. Trials that the eyes spoilt come again at their
/// session's end. Nothing here but the responses decides, so that the same responses lead to the
/// same place: that is how a study goes on after an interruption.
class TrialQueue {
  public:
    /// Precondition: check(plan), subject > 0.
    TrialQueue(const Plan& plan, unsigned subject);

    /// The trial that is to be shown; null: the study is over. The level of Quest is decided.
    [[nodiscard]] const Trial* next() const { return trials_.empty() ? nullptr : &now_; }
    [[nodiscard]] unsigned attempt() const;

    /// The trial of next() has been answered. Gives whether rest comes before the next one.
    Rest answered(const Response& response);

    /// Takes the responses of earlier sittings, in their order. Errors (BadInput): they are not
    /// those of this plan and subject.
    [[nodiscard]] Expected<void> resume(std::span<const Response> responses);

    [[nodiscard]] std::size_t left() const { return trials_.size(); }
    /// Trials that were given up after the plan's attempts.
    [[nodiscard]] unsigned given_up() const { return given_up_; }

  private:
    void decide();
    [[nodiscard]] QuestPlus& staircase(const Trial& trial);

    const Plan* plan_;
    unsigned subject_;
    std::deque<Trial> trials_;
    Trial now_;
    std::map<unsigned, unsigned> attempts_;  ///< of trials that were spoilt, by number
    std::map<std::vector<double>, QuestPlus> staircases_;  ///< by condition
    unsigned given_up_ = 0;
};

}  // namespace gazeloop::study
