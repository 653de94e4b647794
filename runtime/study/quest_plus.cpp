#include "runtime/study/quest_plus.h"

#include <algorithm>
#include <cmath>

namespace gazeloop::study {
namespace {

/// p ln p, with its limit at 0.
double p_log_p(double p) { return p > 0.0 ? p * std::log(p) : 0.0; }

}  // namespace

QuestGrid QuestGrid::over(const std::vector<double>& stimuli, bool rising) {
    constexpr int kThresholds = 32;
    constexpr double kBeyond = 0.25;
    const auto [least, most] = std::ranges::minmax(stimuli);
    const double reach = most > least ? most - least : 1.0;
    QuestGrid grid{.stimuli = stimuli,
                   .thresholds = {},
                   .spreads = {reach / 12.0, reach / 6.0, reach / 3.0, reach / 1.5, reach / 0.75},
                   .rising = rising};
    for (int i = 0; i < kThresholds; ++i) {
        const double share = static_cast<double>(i) / (kThresholds - 1);
        grid.thresholds.push_back(least + reach * ((1.0 + 2.0 * kBeyond) * share - kBeyond));
    }
    return grid;
}

QuestPlus::QuestPlus(QuestGrid grid) : grid_(std::move(grid)) {
    std::vector<statistics::PsychometricFunction> functions;
    for (const double threshold : grid_.thresholds) {
        for (const double spread : grid_.spreads) {
            functions.push_back({.rising = grid_.rising,
                                 .threshold = threshold,
                                 .spread = spread,
                                 .lowest = grid_.lapse,
                                 .highest = grid_.lapse});
            threshold_of_.push_back(threshold);
        }
    }
    weights_.assign(functions.size(), 1.0 / static_cast<double>(functions.size()));
    weight_logs_.assign(functions.size(), p_log_p(weights_.front()));
    terms_.reserve(grid_.stimuli.size() * functions.size());
    for (const double stimulus : grid_.stimuli) {
        for (const statistics::PsychometricFunction& function : functions) {
            const double yes = function.at(stimulus);
            terms_.push_back({.yes = yes, .yes_log = p_log_p(yes), .no_log = p_log_p(1.0 - yes)});
        }
    }
}

double QuestPlus::next() const {
    std::size_t best = 0;
    double least = 0.0;
    for (std::size_t stimulus = 0; stimulus < grid_.stimuli.size(); ++stimulus) {
        // With w' = w p / P: sum_r P_r H_r = sum_r (P_r ln P_r - sum_i w_i p_ri ln(w_i p_ri)).
        double yes = 0.0;
        double joint = 0.0;
        for (std::size_t i = 0; i < weights_.size(); ++i) {
            const Term& t = term(stimulus, i);
            yes += weights_[i] * t.yes;
            joint += weight_logs_[i] + weights_[i] * (t.yes_log + t.no_log);
        }
        const double entropy = p_log_p(yes) + p_log_p(1.0 - yes) - joint;
        if (stimulus == 0 || entropy < least) {
            best = stimulus;
            least = entropy;
        }
    }
    return grid_.stimuli[best];
}

void QuestPlus::answer(double stimulus, bool yes) {
    const auto nearest = static_cast<std::size_t>(
        std::ranges::min_element(grid_.stimuli, {},
                                 [stimulus](double one) { return std::abs(one - stimulus); }) -
        grid_.stimuli.begin());
    double sum = 0.0;
    for (std::size_t i = 0; i < weights_.size(); ++i) {
        const double p = term(nearest, i).yes;
        weights_[i] *= yes ? p : 1.0 - p;
        sum += weights_[i];
    }
    for (std::size_t i = 0; i < weights_.size(); ++i) {
        // An answer that no function on the grid allows (a lapse of 0) leaves all as likely.
        weights_[i] = sum > 0.0 ? weights_[i] / sum : 1.0 / static_cast<double>(weights_.size());
        weight_logs_[i] = p_log_p(weights_[i]);
    }
}

double QuestPlus::entropy() const {
    double sum = 0.0;
    for (const double one : weight_logs_) {
        sum -= one;
    }
    return sum;
}

double QuestPlus::threshold() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < weights_.size(); ++i) {
        sum += weights_[i] * threshold_of_[i];
    }
    return sum;
}

double QuestPlus::deviation() const {
    const double mean = threshold();
    double sum = 0.0;
    for (std::size_t i = 0; i < weights_.size(); ++i) {
        sum += weights_[i] * (threshold_of_[i] - mean) * (threshold_of_[i] - mean);
    }
    return std::sqrt(sum);
}

}  // namespace gazeloop::study
