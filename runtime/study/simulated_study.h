#pragma once

#include <cstdint>
#include <vector>

#include "runtime/study/plan.h"
#include "runtime/study/trial.h"
#include "sim/observer.h"

namespace gazeloop::study {

/// How much worse a test looks than the reference to the mean person, in just noticeable
/// differences, over the axis of levels (Plan::x_of). Never below 0: nothing looks better than the
/// reference.
struct DifferenceCurve {
    struct Point {
        double x = 0.0;
        double difference = 0.0;
    };
    /// Straight lines between these, which go on beyond the ends; by x, two at least.
    std::vector<Point> points;

    /// A line on which the difference is 1 at the threshold and falls to 0 over `width`.
    [[nodiscard]] static DifferenceCurve line(const Plan& plan, double threshold_level,
                                              double width);
    [[nodiscard]] double at(double x) const;
};

/// Who takes part in a simulated study.
struct SimulatedPeople {
    sim::ObserverTerms terms;
    /// One for all conditions, or one for each.
    std::vector<DifferenceCurve> curves;
    std::uint64_t seed = 1;
};

/// What a person has answered, and how long that took.
struct SimulatedSubject {
    std::vector<Response> responses;
    double hours = 0.0;  ///< in the headset, rests left out
};

/// One subject of a study, in virtual time, through the same queue and clock as a run with a
/// person. Preconditions: check(plan), subject > 0, curves for the plan's conditions.
[[nodiscard]] SimulatedSubject simulate_subject(const Plan& plan, const SimulatedPeople& people,
                                                unsigned subject);

/// All responses of subjects 1 to `subjects`. `hours`, unless null, becomes the sum of theirs.
[[nodiscard]] std::vector<Response> simulate_study(const Plan& plan, const SimulatedPeople& people,
                                                   unsigned subjects, double* hours = nullptr);

/// How often such people, before they tire, say yes (decisions.h) at a level in a condition: over
/// both orders, with the scatter of people.
[[nodiscard]] double true_yes(const Plan& plan, const SimulatedPeople& people, double x,
                              std::size_t condition);

/// The level at which that is the plan's criterion; NaN where it never is.
[[nodiscard]] double true_threshold(const Plan& plan, const SimulatedPeople& people,
                                    std::size_t condition);

}  // namespace gazeloop::study
