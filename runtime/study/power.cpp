#include "runtime/study/power.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gazeloop::study {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

double median_or_nan(std::vector<double> values) {
    if (values.empty()) {
        return kNan;
    }
    const auto middle = values.begin() + std::ssize(values) / 2;
    std::ranges::nth_element(values, middle);
    return *middle;
}

double share_or_nan(double part, double whole) { return whole > 0.0 ? part / whole : kNan; }

}  // namespace

PowerRow power_of(const Plan& plan, const SimulatedPeople& people, unsigned subjects,
                  const PowerOptions& options) {
    PowerRow row{.subjects = subjects};
    std::vector<double> widths;
    double answers = 0.0;
    double tests = 0.0;
    double found = 0.0;
    double rule_sum = 0.0;
    double rules = 0.0;
    std::vector<double> truths;
    truths.reserve(plan.conditions());
    for (std::size_t condition = 0; condition < plan.conditions(); ++condition) {
        truths.push_back(plan.x_of(true_threshold(plan, people, condition)));
    }
    for (unsigned study = 0; study < options.studies; ++study) {
        if (options.interrupted && options.interrupted()) {
            break;
        }
        // Other people, in other orders.
        Plan own = plan;
        own.seed = plan.seed + study;
        SimulatedPeople own_people = people;
        own_people.seed = people.seed + study;
        double hours = 0.0;
        const std::vector<Response> responses = simulate_study(own, own_people, subjects, &hours);
        row.minutes += hours * 60.0;
        const StudyResult result =
            analyse(own, responses, {.resamples = options.resamples, .seed = own.seed});
        ++row.studies;
        row.excluded += static_cast<double>(result.excluded());
        for (const SubjectResult& subject : result.subjects) {
            answers += static_cast<double>(subject.answers);
        }
        for (std::size_t condition = 0; condition < result.thresholds.size(); ++condition) {
            const ThresholdResult& threshold = result.thresholds[condition];
            const double truth = truths[condition];
            if (threshold.subjects > 0) {
                rule_sum += threshold.mean;
                rules += 1.0;
            }
            if (!threshold.fit || std::isnan(truth)) {
                continue;
            }
            ++row.intervals;
            row.holding += threshold.fit->low <= truth && truth <= threshold.fit->high ? 1 : 0;
            row.bias += threshold.fit->x - truth;
            widths.push_back(0.5 * (threshold.fit->high - threshold.fit->low));
        }
        for (const LevelTest& test : result.tests) {
            tests += 1.0;
            found += test.q && test.q->p < 0.05 ? 1.0 : 0.0;
        }
    }
    const double persons = static_cast<double>(row.studies) * subjects;
    row.minutes = share_or_nan(row.minutes, persons);
    row.answers = share_or_nan(answers, persons);
    row.excluded = share_or_nan(row.excluded, row.studies);
    row.bias = share_or_nan(row.bias, static_cast<double>(row.intervals));
    row.half_width = median_or_nan(std::move(widths));
    row.q_found = share_or_nan(found, tests);
    row.rule_mean = share_or_nan(rule_sum, rules);
    return row;
}

std::vector<unsigned> power_steps(const Plan& plan) {
    std::vector<unsigned> steps;
    for (const unsigned quarters : {1U, 2U, 4U, 8U}) {
        const unsigned subjects = std::max(plan.subjects * quarters / 4U, 2U);
        if (steps.empty() || subjects > steps.back()) {
            steps.push_back(subjects);
        }
    }
    return steps;
}

Plan as_long_as(const Plan& plan, const SimulatedPeople& people, double minutes) {
    Plan longer = plan;
    longer.sessions = plan.least_sessions();
    longer.repeats = 1;
    const double once = simulate_subject(longer, people, 1).hours * 60.0;
    longer.repeats = 2;
    const double each = simulate_subject(longer, people, 1).hours * 60.0 - once;
    constexpr double kMostRepeats = 1000.0;
    longer.repeats = static_cast<unsigned>(
        std::clamp(std::round((minutes - once) / std::max(each, 1e-9) + 1.0), 1.0, kMostRepeats));
    return longer;
}

}  // namespace gazeloop::study
