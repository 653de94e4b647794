#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/statistics/psychometric_fit.h"

namespace gazeloop::study {

/// What an adaptive staircase may show, and what it takes for possible beforehand (each as likely).
struct QuestGrid {
    std::vector<double> stimuli;     ///< on the axis of levels
    std::vector<double> thresholds;  ///< likewise
    std::vector<double> spreads;     ///< > 0
    bool rising = true;              ///< as in PsychometricFunction
    double lapse = 0.02;             ///< lowest and highest, of every function

    /// For these levels: thresholds 32 from a quarter of the reach before one end to as much behind
    /// the other, since an asked-for share of yes may lie far from where yes and no are even;
    /// spreads a twelfth, a sixth, a third, two and four thirds of the reach.
    [[nodiscard]] static QuestGrid over(const std::vector<double>& stimuli, bool rising);
};

/// QUEST+ (Watson 2017): keeps the probability of each psychometric function on a grid, and asks
/// next where the answer is expected to leave the least entropy. By way of the psychometric
/// function of psychometric_fit.h.
class QuestPlus {
  public:
    /// Precondition: no list of the grid is empty, and all stimuli are finite.
    explicit QuestPlus(QuestGrid grid);

    /// The stimulus to ask next; the first of equals.
    [[nodiscard]] double next() const;
    /// An answer at a stimulus: taken for the nearest of the grid.
    void answer(double stimulus, bool yes);

    [[nodiscard]] double entropy() const;    ///< of what is still possible, in nats
    [[nodiscard]] double threshold() const;  ///< its mean
    [[nodiscard]] double deviation() const;  ///< of the threshold

  private:
    struct Term {
        double yes;      ///< probability
        double yes_log;  ///< p ln p
        double no_log;   ///< (1 - p) ln(1 - p)
    };
    [[nodiscard]] const Term& term(std::size_t stimulus, std::size_t function) const {
        return terms_[stimulus * weights_.size() + function];
    }

    QuestGrid grid_;
    std::vector<double> weights_;      ///< of each function; their sum is 1
    std::vector<double> weight_logs_;  ///< w ln w
    std::vector<double> threshold_of_;
    std::vector<Term> terms_;
};

}  // namespace gazeloop::study
