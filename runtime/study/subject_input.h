#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "runtime/error.h"
#include "runtime/study/simulated_study.h"
#include "runtime/study/trial_clock.h"

namespace gazeloop::study {

/// Where presses come from: a person, or a simulated one.
class SubjectInput {
  public:
    SubjectInput() = default;
    SubjectInput(const SubjectInput&) = delete;
    SubjectInput& operator=(const SubjectInput&) = delete;
    virtual ~SubjectInput() = default;

    /// What was pressed up to this time, at what is shown now; null: the study is over. Never
    /// blocks.
    virtual std::vector<Press> presses(std::int64_t now_ns, const Shown& shown, const Trial* trial,
                                       unsigned attempt) = 0;
};

/// The terminal's keys, each as it is pressed, without echo; or the bytes of what stands in for the
/// terminal. What a key means is the design's: keys_text() says it. The terminal is as before in
/// the end.
[[nodiscard]] std::unique_ptr<SubjectInput> keyboard_input(Design design);
[[nodiscard]] std::string keys_text(Design design);

/// A simulated person, who rests as long as the plan says. Both must outlive it.
[[nodiscard]] std::unique_ptr<SubjectInput> simulated_input(const Plan& plan,
                                                            const SimulatedPeople& people,
                                                            unsigned subject);

}  // namespace gazeloop::study
