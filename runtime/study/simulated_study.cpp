#include "runtime/study/simulated_study.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "runtime/statistics/distributions.h"
#include "runtime/study/simulated_person.h"
#include "runtime/study/trial_clock.h"

namespace gazeloop::study {
DifferenceCurve DifferenceCurve::line(const Plan& plan, double threshold_level, double width) {
    const double x = plan.x_of(threshold_level);
    const double away = plan.higher_is_better ? -width : width;
    std::vector<Point> points{{x - away, 0.0}, {x, 1.0}};
    std::ranges::sort(points, {}, &Point::x);
    return {std::move(points)};
}

double DifferenceCurve::at(double x) const {
    const auto after = std::ranges::upper_bound(points, x, {}, &Point::x);
    const auto last = std::clamp<std::ptrdiff_t>(after - points.begin(), 1, std::ssize(points) - 1);
    const Point& a = points[static_cast<std::size_t>(last - 1)];
    const Point& b = points[static_cast<std::size_t>(last)];
    const double share = (x - a.x) / (b.x - a.x);
    return std::max(a.difference + share * (b.difference - a.difference), 0.0);
}

SimulatedSubject simulate_subject(const Plan& plan, const SimulatedPeople& people,
                                  unsigned subject) {
    constexpr double kNsPerHour = 3600e9;
    const auto ns = [](double seconds) { return std::llround(seconds * 1e9); };
    TrialQueue queue(plan, subject);
    TrialClock clock(plan, queue, subject);
    SimulatedPerson person(plan, people, subject);
    SimulatedSubject result;
    std::int64_t now = 0;
    std::int64_t rested = 0;
    clock.watch(now, Eyes::OnTarget);
    for (;;) {
        const Shown shown = clock.at(now);
        if (shown.screen == Screen::Over) {
            break;
        }
        if (shown.screen == Screen::Rest) {
            now += ns(plan.rest_s);
            rested += ns(plan.rest_s);
            value_or_throw(clock.press(now, Press::GoOn));
            continue;
        }
        const Trial& trial = *queue.next();
        if (const auto change = clock.changes_ns()) {
            if (shown.screen == Screen::Picture) {
                person.see(shown, trial);
            }
            now = *change;
            continue;
        }
        now += ns(plan.answer_s);
        const double hours = static_cast<double>(now - rested) / kNsPerHour;
        value_or_throw(clock.press(now, person.answer(shown, trial, queue.attempt(), hours)));
        for (Response& response : clock.take_responses()) {
            result.responses.push_back(std::move(response));
        }
    }
    result.hours = static_cast<double>(now - rested) / kNsPerHour;
    return result;
}

std::vector<Response> simulate_study(const Plan& plan, const SimulatedPeople& people,
                                     unsigned subjects, double* hours) {
    std::vector<Response> responses;
    double sum = 0.0;
    for (unsigned subject = 1; subject <= subjects; ++subject) {
        const SimulatedSubject one = simulate_subject(plan, people, subject);
        sum += one.hours;
        responses.insert(responses.end(), one.responses.begin(), one.responses.end());
    }
    if (hours != nullptr) {
        *hours = sum;
    }
    return responses;
}

double true_yes(const Plan& plan, const SimulatedPeople& people, double x, std::size_t condition) {
    const DifferenceCurve& curve = people.curves[people.curves.size() > 1 ? condition : 0];
    const sim::ObserverTerms& terms = people.terms;
    const std::vector<double>& levels = plan.factors.front().levels;
    const double best = plan.x_of(plan.higher_is_better ? levels.back() : levels.front());
    const bool three = plan.design == Design::Pair || plan.design == Design::Ramp;
    // The noise stays below what is left up to the criterion of 1.
    const auto below = [&](double difference) {
        const double left = 1.0 - difference;
        return terms.noise > 0.0 ? statistics::normal_share(left / terms.noise)
                                 : (left >= 0.0 ? 1.0 : 0.0);
    };
    const auto decided = [&](double shift) {
        const double difference =
            curve.at(x - shift) - (plan.design == Design::Ramp ? curve.at(best - shift) : 0.0);
        return three ? 0.5 * (below(difference - terms.bias) + below(difference + terms.bias))
                     : below(difference + terms.bias);
    };
    // The trapezoidal rule over people, 5 deviations to either side.
    constexpr int kSteps = 100;
    double sum = 0.0;
    double weights = 0.0;
    for (int step = -kSteps; step <= kSteps; ++step) {
        const double z = 5.0 * step / kSteps;
        const double weight = std::exp(-0.5 * z * z);
        sum += weight * decided(z * terms.people);
        weights += weight;
    }
    return terms.lapse * (three ? 2.0 / 3.0 : 0.5) + (1.0 - terms.lapse) * sum / weights;
}

double true_threshold(const Plan& plan, const SimulatedPeople& people, std::size_t condition) {
    const std::vector<double>& levels = plan.factors.front().levels;
    double good = plan.x_of(plan.higher_is_better ? levels.back() : levels.front());
    double bad = plan.x_of(plan.higher_is_better ? levels.front() : levels.back());
    const auto enough = [&](double x) {
        return true_yes(plan, people, x, condition) >= plan.criterion;
    };
    if (!enough(good) || enough(bad)) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (good + bad);
        (enough(middle) ? good : bad) = middle;
    }
    return plan.level_at(0.5 * (good + bad));
}

}  // namespace gazeloop::study
