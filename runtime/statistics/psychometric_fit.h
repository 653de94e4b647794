#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace gazeloop::statistics {

/// How often one person said yes at one level.
struct LevelCount {
    double x = 0.0;  ///< finite
    std::uint32_t trials = 0;
    std::uint32_t yes = 0;
};

/// P(yes | x) = lowest + (1 - lowest - highest) Phi(g(u)), u = +-(x - threshold) / spread and
/// g(u) = (exp(bend u) - 1) / bend, u itself where bend is 0: the cumulative normal of a noisy
/// decision on what grows with x by a straight line or, over a logarithmic axis, with a power of
/// the level; and answers of which no look at the pictures decides.
struct PsychometricFunction {
    bool rising = true;      ///< whether yes becomes more frequent with x
    double threshold = 0.0;  ///< where the decision goes either way, in the unit of x
    double spread = 1.0;     ///< of the noise, in the unit of x; > 0
    double lowest = 0.0;     ///< share of yes where no decision is yes, in [0, kMostLapse]
    double highest = 0.0;    ///< share of no where every decision is yes, in [0, kMostLapse]
    double bend = 0.0;       ///< above 0: steeper where yes is more frequent

    /// g, and its derivatives by u and by bend.
    struct Bent {
        double value;
        double by_u;
        double by_bend;
    };
    [[nodiscard]] static Bent bent(double u, double bend);

    [[nodiscard]] double at(double x) const;
    /// The x at which yes is so frequent. Where it comes so far nowhere: the x beyond which it
    /// changes by no more than a thousandth.
    [[nodiscard]] double x_where(double yes) const;
};

inline constexpr double kMostLapse = 0.2;

/// A psychometric function of many people.
struct FittedPeople {
    PsychometricFunction function;  ///< of the mean person; of all together where levels are fixed
    double people = 0.0;            ///< deviation of thresholds between people; 0: not fitted

    /// The function of all people's answers together, whose spread holds that of the people: to the
    /// first order of the bend.
    [[nodiscard]] PsychometricFunction together() const;
};

struct FitOptions {
    bool rising = true;
    /// The levels that a person was asked depend on that person's answers (a staircase, a slider).
    /// Only a model of what each person answered then gives the truth: thresholds are normal over
    /// people. Otherwise all answers together are fitted by one function, whose spread holds the
    /// people's too.
    bool adaptive = false;
    double criterion = 0.5;         ///< share of yes at the threshold: in (0, 1)
    std::uint64_t seed = 1;         ///< of the bootstrap, or of draws from the posterior
    std::uint32_t resamples = 200;  ///< at least 50; ten draws stand for one
    double level = 0.95;            ///< of the interval
};

/// The most probable functions, by Newton's method on the likelihood (for thresholds that vary, by
/// Louis's information, 1982) and weak priors: without these, few answers, or ones that change all
/// at once, have no finite fit. With r the reach of the levels tried (at least 1e-3): threshold
/// normal about their middle with deviation 2 r; ln spread normal about ln(r / 5) and ln people
/// about ln(r / 10), both with 1.5; lowest and highest about 1.5 % on a logit scale below
/// kMostLapse, with 1.5; bend about 0 with 1. Twenty answers near the threshold outweigh them.
/// `subjects`: the counts of each. Precondition: one of them has trials.
[[nodiscard]] FittedPeople fit_people(std::span<const std::vector<LevelCount>> subjects,
                                      const FitOptions& options);

/// What all subjects' answers say together.
struct FittedThreshold {
    FittedPeople people;
    double x = 0.0;          ///< where all people's answers together meet the criterion
    double low = 0.0;        ///< of the interval
    double high = 0.0;       ///< likewise
    double deviation = 0.0;  ///< of x, by the bootstrap and the bend, or by the posterior
    bool outside = false;    ///< x lies beyond the levels tried: a guess by the priors
};

/// Fits all subjects' answers. Levels that are fixed, several subjects: whole subjects are
/// resampled, since answers of one are not independent, and the interval is x +- t sqrt(n / (n -
/// 1)) deviation with Student's t of n - 1 degrees of freedom, because so few subjects' resamples
/// vary too little; in the deviation is how much x would change if the bend's prior lay a deviation
/// aside. One subject: answers are drawn from the fit, and the interval is x +- z deviation.
/// Adaptive: x is the median of the posterior and the interval lies between its quantiles. Whoever
/// seems to see well there has told less of where the function goes on, so that errors and
/// deviations go together, and an interval as wide to both sides would miss. Precondition: as
/// fit_people().
[[nodiscard]] FittedThreshold fit_threshold(std::span<const std::vector<LevelCount>> subjects,
                                            const FitOptions& options);

}  // namespace gazeloop::statistics
