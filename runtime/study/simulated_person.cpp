#include "runtime/study/simulated_person.h"

#include <cmath>

#include "runtime/study/subject_thresholds.h"

namespace gazeloop::study {
namespace {

constexpr std::uint64_t kLooksPerTrial = 4096;

}  // namespace

void SimulatedPerson::see(const Shown& shown, const Trial& trial) {
    last_ = shown.reference ? 0.0 : difference_at(shown.level, trial);
    if (seen_ == 0) {
        first_ = last_;
        step_ = 0;
        compared_ = false;
    }
    ++seen_;
}

Press SimulatedPerson::answer(const Shown& shown, const Trial& trial, unsigned attempt,
                              double hours) {
    const std::uint64_t look = trial.number * kLooksPerTrial + std::uint64_t{attempt} * 64U;
    Press press = Press::Same;
    switch (plan_.design) {
        case Design::SameDifferent:
        case Design::Quest:
            press = observer_.sees_difference(std::abs(last_ - first_), look, hours)
                        ? Press::Different
                        : Press::Same;
            break;
        case Design::Pair:
            press = compared(look, hours, Press::First, Press::Second);
            break;
        case Design::Ramp:
            press = compared(look, hours, Press::Down, Press::Up);
            break;
        case Design::Slider:
            return slide(shown, trial, hours);
    }
    seen_ = 0;
    return press;
}

Press SimulatedPerson::slide(const Shown& shown, const Trial& trial, double hours) {
    if (compared_) {
        seen_ = 0;
        return Press::Done;
    }
    if (!observer_.sees_difference(difference_at(shown.level, trial),
                                   trial.number * kLooksPerTrial + step_++, hours)) {
        compared_ = true;
        return Press::Reference;
    }
    if (step_ == plan_.factors.front().levels.size()) {
        seen_ = 0;
        return Press::Unable;
    }
    return Press::Raise;
}

double SimulatedPerson::difference_at(double level, const Trial& trial) const {
    const std::size_t curve = people_.curves.size() > 1 ? condition_of(plan_, trial) : 0;
    return people_.curves[curve].at(plan_.x_of(level) - observer_.shift());
}

Press SimulatedPerson::compared(std::uint64_t look, double hours, Press first_better,
                                Press second_better) const {
    switch (observer_.compare(last_ - first_, look, hours)) {
        case sim::Comparison::FirstBetter:
            return first_better;
        case sim::Comparison::SecondBetter:
            return second_better;
        case sim::Comparison::Same:
            break;
    }
    return Press::Same;
}

}  // namespace gazeloop::study
