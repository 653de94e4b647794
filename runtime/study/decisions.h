#pragma once

#include <vector>

#include "runtime/study/plan.h"
#include "runtime/study/trial.h"

namespace gazeloop::study {

/// What an answer says of one level: yes is that the test was as good as the reference.
struct Decision {
    double level = 0.0;
    bool yes = false;
};

/// What a response says: one decision, and of a slider one for each level that was passed (no) and
/// that at which it stopped (yes). SameDifferent and Quest: same. Pair: the test is the better one,
/// or the same. Ramp: no change was seen, or the wrong way. None from a trial that is spoilt, for
/// training or validation, or from an answer that the design does not have.
[[nodiscard]] std::vector<Decision> decisions_of(const Plan& plan, const Response& response);

/// Whether the levels that a subject is asked depend on that subject's answers.
[[nodiscard]] bool adaptive(Design design);

/// Whether an answer is one of the design's.
[[nodiscard]] bool answers(Design design, Answer answer);

/// Whether a subject took two equal pictures for different ones.
[[nodiscard]] bool failed_validation(const Response& response);

}  // namespace gazeloop::study
