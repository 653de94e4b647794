#pragma once

#include <functional>
#include <span>
#include <vector>

#include "runtime/study/analysis.h"
#include "runtime/study/plan.h"
#include "runtime/study/simulated_study.h"

namespace gazeloop::study {

/// What so many people in so many simulated studies find out.
struct PowerRow {
    unsigned subjects = 0;
    unsigned studies = 0;
    double minutes = 0.0;   ///< per person in the headset, without rests: mean
    double answers = 0.0;   ///< per person: mean of those that count
    double excluded = 0.0;  ///< people per study: mean
    // Of the fitted thresholds, over studies and conditions.
    std::size_t intervals = 0;  ///< how many have an interval and a true threshold
    std::size_t holding = 0;    ///< of these: hold the true threshold
    double half_width = 0.0;    ///< median, on the axis of levels
    double bias = 0.0;          ///< mean of fitted less true, on the axis of levels
    /// Share of the levels' Cochran's Q below 0.05; NaN where the plan has none.
    double q_found = 0.0;
    /// Of the rule's thresholds: mean, in levels; NaN without any.
    double rule_mean = 0.0;

    [[nodiscard]] double share_holding() const {
        return static_cast<double>(holding) / static_cast<double>(intervals);
    }
};

struct PowerOptions {
    unsigned studies = 100;
    std::uint32_t resamples = 200;
    std::function<bool()> interrupted{};  ///< asked between studies; ends with what there is
};

/// Simulates studies by a plan with so many subjects. Each study has people of its own.
/// Preconditions: those of simulate_subject(), subjects > 0, studies > 0.
[[nodiscard]] PowerRow power_of(const Plan& plan, const SimulatedPeople& people, unsigned subjects,
                                const PowerOptions& options);

/// Numbers of subjects that show how a plan gains by more: a quarter of its own, a half, all, and
/// twice as many; each at least 2.
[[nodiscard]] std::vector<unsigned> power_steps(const Plan& plan);

/// The plan with so many repeats of its cells that a person is in the headset about that long, at
/// least one: for a comparison of designs at equal minutes. `minutes` > 0.
[[nodiscard]] Plan as_long_as(const Plan& plan, const SimulatedPeople& people, double minutes);

}  // namespace gazeloop::study
