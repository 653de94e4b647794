#pragma once

#include "runtime/study/simulated_study.h"
#include "runtime/study/trial_clock.h"

namespace gazeloop::study {

/// A simulated person who looks at what a TrialClock shows, and presses. Both must outlive it.
class SimulatedPerson {
  public:
    SimulatedPerson(const Plan& plan, const SimulatedPeople& people, unsigned subject)
        : plan_(plan), people_(people), observer_(people.terms, people.seed, subject) {}

    /// A picture comes up. Precondition: once per part of a trial.
    void see(const Shown& shown, const Trial& trial);

    /// What is pressed at the question, or while a slider's level is shown. `hours` have gone by.
    [[nodiscard]] Press answer(const Shown& shown, const Trial& trial, unsigned attempt,
                               double hours);

  private:
    [[nodiscard]] Press slide(const Shown& shown, const Trial& trial, double hours);
    [[nodiscard]] double difference_at(double level, const Trial& trial) const;
    [[nodiscard]] Press compared(std::uint64_t look, double hours, Press first_better,
                                 Press second_better) const;

    const Plan& plan_;
    const SimulatedPeople& people_;
    sim::Observer observer_;
    unsigned seen_ = 0;
    double first_ = 0.0;
    double last_ = 0.0;
    unsigned step_ = 0;      ///< of a slider
    bool compared_ = false;  ///< likewise: the reference is shown once more
};

}  // namespace gazeloop::study
