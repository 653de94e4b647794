#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "runtime/error.h"
#include "runtime/present/button_source.h"
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

    /// Whether nobody can press anything any more.
    [[nodiscard]] virtual bool ended() const { return false; }
};

/// A person's: see person_input().
class PersonInput : public SubjectInput {
  public:
    /// Where presses come from beside the terminal. All must outlive the calls of presses().
    virtual void listen_to(std::vector<present::ButtonSource*> sources) = 0;
};

/// The terminal's keys, each as it is pressed, without echo; or the bytes of what stands in for the
/// terminal; and the buttons that it listens to. What they mean is the design's (controls.h). The
/// terminal is as before in the end.
[[nodiscard]] std::unique_ptr<PersonInput> person_input(Design design);

/// A simulated person, who rests as long as the plan says. Both must outlive it.
[[nodiscard]] std::unique_ptr<SubjectInput> simulated_input(const Plan& plan,
                                                            const SimulatedPeople& people,
                                                            unsigned subject);

}  // namespace gazeloop::study
