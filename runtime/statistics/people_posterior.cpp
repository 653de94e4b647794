#include "runtime/statistics/people_posterior.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "runtime/statistics/distributions.h"

namespace gazeloop::statistics {
namespace {

constexpr double kUsualLapse = 0.015;
constexpr double kPriorSpreads = 1.5;
constexpr double kLeastReach = 1e-3;
constexpr int kMostSteps = 60;

double lapse_of(double logit) { return kMostLapse / (1.0 + std::exp(-logit)); }

}  // namespace

PeoplePosterior::PeoplePosterior(std::span<const std::vector<LevelCount>> subjects, bool rising,
                                 bool varying)
    : rising_(rising) {
    for (const std::vector<LevelCount>& of_subject : subjects) {
        for (const LevelCount& one : of_subject) {
            if (one.trials > 0) {
                levels_.push_back(one.x);
            }
        }
    }
    std::ranges::sort(levels_);
    levels_.erase(std::ranges::unique(levels_).begin(), levels_.end());
    for (const std::vector<LevelCount>& of_subject : subjects) {
        std::vector<Count> row(levels_.size());
        bool any = false;
        for (const LevelCount& one : of_subject) {
            if (one.trials > 0) {
                const auto at = std::ranges::lower_bound(levels_, one.x) - levels_.begin();
                row[static_cast<std::size_t>(at)].trials += one.trials;
                row[static_cast<std::size_t>(at)].yes += one.yes;
                any = true;
            }
        }
        if (any) {
            counts_.insert(counts_.end(), row.begin(), row.end());
            ++subjects_;
        }
    }
    reach_ = std::max(levels_.back() - levels_.front(), kLeastReach);
    const double lapse = std::log(kUsualLapse / (kMostLapse - kUsualLapse));
    priors_ << 0.5 * (levels_.front() + levels_.back()), std::log(reach_ / 5.0), lapse, lapse,
        std::log(reach_ / 10.0), 0.0;
    prior_deviations_ << 2.0 * reach_, kPriorSpreads, kPriorSpreads, kPriorSpreads, kPriorSpreads,
        kPriorBend;
    if (!varying || subjects_ < 2) {
        nodes_.push_back({});
        return;
    }
    // Half a deviation of the people, or finer where a subject's many answers place its threshold
    // more finely than that.
    double most = 0.0;
    for (std::size_t subject = 0; subject < subjects_; ++subject) {
        double trials = 0.0;
        for (std::size_t level = 0; level < levels_.size(); ++level) {
            trials += count(subject, level).trials;
        }
        most = std::max(most, trials);
    }
    constexpr double kFarthest = 3.5;
    const int steps = static_cast<int>(
        std::lround(kFarthest / std::clamp(0.5 * std::sqrt(60.0 / most), 0.1, 0.5)));
    double sum = 0.0;
    for (int step = -steps; step <= steps; ++step) {
        const double z = kFarthest * step / steps;
        nodes_.push_back({.z = z, .log_weight = -0.5 * z * z});
        sum += std::exp(-0.5 * z * z);
    }
    for (Node& node : nodes_) {
        node.log_weight -= std::log(sum);
    }
}

PeoplePosterior PeoplePosterior::with_bend_about(double bend) const {
    PeoplePosterior other = *this;
    other.priors_[5] = bend;
    return other;
}

std::vector<LevelCount> PeoplePosterior::counts(std::size_t subject) const {
    std::vector<LevelCount> list;
    for (std::size_t level = 0; level < levels_.size(); ++level) {
        const Count& one = count(subject, level);
        list.push_back({.x = levels_[level],
                        .trials = static_cast<std::uint32_t>(one.trials),
                        .yes = static_cast<std::uint32_t>(one.yes)});
    }
    return list;
}

FittedPeople PeoplePosterior::function_of(const Parameters& parameters) const {
    return {.function = {.rising = rising_,
                         .threshold = parameters[0],
                         .spread = std::exp(parameters[1]),
                         .lowest = lapse_of(parameters[2]),
                         .highest = lapse_of(parameters[3]),
                         .bend = parameters[5]},
            .people = nodes_.size() > 1 ? std::exp(parameters[4]) : 0.0};
}

PeoplePosterior::Point PeoplePosterior::point(double x, double z,
                                              const FittedPeople& people) const {
    const PsychometricFunction& f = people.function;
    const double sign = f.rising ? 1.0 : -1.0;
    const double deviation = sign * (x - f.threshold - people.people * z) / f.spread;
    const PsychometricFunction::Bent bent = PsychometricFunction::bent(deviation, f.bend);
    const double decided = normal_share(bent.value);
    const double range = 1.0 - f.lowest - f.highest;
    const double of_bent =
        range * std::exp(-0.5 * bent.value * bent.value) / std::sqrt(2.0 * std::numbers::pi);
    const double density = of_bent * bent.by_u;
    Point point;
    // Away from 0 and 1, because lowest and highest are never 0.
    point.p = f.lowest + range * decided;
    point.yes_log = std::log(point.p);
    point.no_log = std::log1p(-point.p);
    point.weight = 1.0 / (point.p * (1.0 - point.p));
    point.slope << -sign * density / f.spread, -density * deviation,
        (1.0 - decided) * f.lowest * (1.0 - f.lowest / kMostLapse),
        -decided * f.highest * (1.0 - f.highest / kMostLapse),
        -sign * density / f.spread * people.people * z, of_bent * bent.by_bend;
    return point;
}

void PeoplePosterior::add_together(Value& value, const std::vector<Point>& points,
                                   std::span<const double> times) const {
    for (std::size_t level = 0; level < levels_.size(); ++level) {
        Count all;
        for (std::size_t subject = 0; subject < subjects_; ++subject) {
            all.trials += times[subject] * count(subject, level).trials;
            all.yes += times[subject] * count(subject, level).yes;
        }
        const Point& here = points[level];
        value.logarithm += all.yes * here.yes_log + (all.trials - all.yes) * here.no_log;
        value.gradient += (all.yes - all.trials * here.p) * here.weight * here.slope;
        value.complete += all.trials * here.weight * here.slope * here.slope.transpose();
    }
}

void PeoplePosterior::add_varying(Value& value, const std::vector<Point>& points,
                                  std::span<const double> times) const {
    const std::size_t levels = levels_.size();
    std::vector<double> logs(nodes_.size());
    std::vector<double> asked(points.size(), 0.0);  // trials, by how probable the node is
    for (std::size_t subject = 0; subject < subjects_; ++subject) {
        if (times[subject] == 0.0) {
            continue;
        }
        for (std::size_t node = 0; node < nodes_.size(); ++node) {
            logs[node] = nodes_[node].log_weight;
            for (std::size_t level = 0; level < levels; ++level) {
                const Count& one = count(subject, level);
                const Point& here = points[node * levels + level];
                logs[node] += one.yes * here.yes_log + (one.trials - one.yes) * here.no_log;
            }
        }
        const double greatest = std::ranges::max(logs);
        double sum = 0.0;
        for (const double one : logs) {
            sum += std::exp(one - greatest);
        }
        Parameters mean = Parameters::Zero();
        Square squares = Square::Zero();
        for (std::size_t node = 0; node < nodes_.size(); ++node) {
            const double share = std::exp(logs[node] - greatest) / sum;
            if (share < 1e-6) {
                continue;  // below what the rule itself leaves out
            }
            Parameters score = Parameters::Zero();
            for (std::size_t level = 0; level < levels; ++level) {
                const Count& one = count(subject, level);
                if (one.trials > 0.0) {
                    const std::size_t at = node * levels + level;
                    const Point& here = points[at];
                    score += (one.yes - one.trials * here.p) * here.weight * here.slope;
                    asked[at] += times[subject] * share * one.trials;
                }
            }
            mean += share * score;
            squares += share * score * score.transpose();
        }
        value.logarithm += times[subject] * (greatest + std::log(sum));
        value.gradient += times[subject] * mean;
        value.missing += times[subject] * (squares - mean * mean.transpose());
    }
    for (std::size_t at = 0; at < points.size(); ++at) {
        value.complete +=
            asked[at] * points[at].weight * points[at].slope * points[at].slope.transpose();
    }
}

PeoplePosterior::Value PeoplePosterior::at(const Parameters& parameters,
                                           std::span<const double> times) const {
    const FittedPeople people = function_of(parameters);
    std::vector<Point> points;
    points.reserve(nodes_.size() * levels_.size());
    for (const Node& node : nodes_) {
        for (const double x : levels_) {
            points.push_back(point(x, node.z, people));
        }
    }
    Value value;
    if (nodes_.size() > 1) {
        add_varying(value, points, times);
    } else {
        add_together(value, points, times);
    }
    for (int i = 0; i < priors_.size(); ++i) {
        const double weight = 1.0 / (prior_deviations_[i] * prior_deviations_[i]);
        const double off = parameters[i] - priors_[i];
        value.logarithm -= 0.5 * weight * off * off;
        value.gradient[i] -= weight * off;
        value.complete(i, i) += weight;
    }
    return value;
}

double PeoplePosterior::logarithm(const Parameters& at) const {
    return this->at(at, std::vector<double>(subjects_, 1.0)).logarithm;
}

PeoplePosterior::Square PeoplePosterior::information(const Parameters& at) const {
    const Value here = this->at(at, std::vector<double>(subjects_, 1.0));
    const Square information = here.complete - here.missing;
    return Eigen::LLT<Square>(information).info() == Eigen::Success ? information : here.complete;
}

PeoplePosterior::Parameters PeoplePosterior::most_probable(Parameters from,
                                                           std::span<const double> times) const {
    Value here = at(from, times);
    for (int step = 0; step < kMostSteps; ++step) {
        // Far from the top more may be missing than there is: then as if nothing were.
        Eigen::LLT<Square> information(here.complete - here.missing);
        if (information.info() != Eigen::Success) {
            information.compute(here.complete);
        }
        Parameters change = information.solve(here.gradient);
        // No step leaves the region in which the curvature means anything.
        const double longest =
            std::max(std::abs(change[0]) / reach_, change.tail<5>().cwiseAbs().maxCoeff());
        change /= std::max(longest, 1.0);
        Value there = at(from + change, times);
        for (int halving = 0; halving < 20 && !(there.logarithm >= here.logarithm); ++halving) {
            change *= 0.5;
            there = at(from + change, times);
        }
        if (!(there.logarithm >= here.logarithm)) {
            break;  // at the top, to within rounding
        }
        const double gained = there.logarithm - here.logarithm;
        from += change;
        here = there;
        if (gained < 1e-7) {
            break;
        }
    }
    return from;
}

}  // namespace gazeloop::statistics
