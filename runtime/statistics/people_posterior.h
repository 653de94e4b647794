#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "runtime/statistics/psychometric_fit.h"

namespace gazeloop::statistics {

/// The posterior of psychometric_fit.h's functions: what is known of their parameters from
/// subjects' answers and the priors. Thresholds that vary over people are integrated over by the
/// trapezoidal rule, whose error falls faster than any power for a normal distribution (here below
/// 1e-3 of a subject's likelihood while its own spread is above a third of the people's).
class PeoplePosterior {
  public:
    /// Threshold, ln spread, logits of lowest and highest below kMostLapse, ln people, bend.
    using Parameters = Eigen::Matrix<double, 6, 1>;

    /// Precondition: a subject has trials.
    PeoplePosterior(std::span<const std::vector<LevelCount>> subjects, bool rising, bool varying);

    /// Those with trials.
    [[nodiscard]] std::size_t subjects() const { return subjects_; }
    [[nodiscard]] double least() const { return levels_.front(); }
    [[nodiscard]] double most() const { return levels_.back(); }
    [[nodiscard]] std::vector<LevelCount> counts(std::size_t subject) const;

    [[nodiscard]] Parameters start() const { return priors_; }
    /// The same answers, had the prior of the bend another middle.
    [[nodiscard]] PeoplePosterior with_bend_about(double bend) const;
    static constexpr double kPriorBend = 1.0;  ///< deviation of the bend's prior

    using Square = Eigen::Matrix<double, 6, 6>;
    /// Its logarithm, but for a constant, with each subject once.
    [[nodiscard]] double logarithm(const Parameters& at) const;
    /// Minus the second derivatives of that; where these are not positive definite, what they would
    /// be if each person's threshold were known.
    [[nodiscard]] Square information(const Parameters& at) const;

    /// From there uphill. `times`: how often each subject counts.
    [[nodiscard]] Parameters most_probable(Parameters from, std::span<const double> times) const;
    [[nodiscard]] FittedPeople function_of(const Parameters& parameters) const;

  private:
    struct Count {
        double trials = 0.0;
        double yes = 0.0;
    };
    struct Node {
        double z = 0.0;  ///< deviations from the mean person
        double log_weight = 0.0;
    };
    struct Value {
        double logarithm = 0.0;
        Parameters gradient = Parameters::Zero();
        Square complete = Square::Zero();  ///< information, were each person's threshold known
        Square missing = Square::Zero();   ///< how much less it is
    };
    /// The likelihood at one level and node.
    struct Point {
        double yes_log = 0.0;
        double no_log = 0.0;
        double p = 0.5;
        double weight = 0.0;  ///< 1 / (p (1 - p))
        Parameters slope = Parameters::Zero();
    };

    [[nodiscard]] Point point(double x, double z, const FittedPeople& people) const;
    [[nodiscard]] Value at(const Parameters& parameters, std::span<const double> times) const;
    void add_together(Value& value, const std::vector<Point>& points,
                      std::span<const double> times) const;
    void add_varying(Value& value, const std::vector<Point>& points,
                     std::span<const double> times) const;
    [[nodiscard]] const Count& count(std::size_t subject, std::size_t level) const {
        return counts_[subject * levels_.size() + level];
    }

    bool rising_;
    std::vector<Node> nodes_;  ///< one, if thresholds do not vary
    std::vector<double> levels_;
    std::size_t subjects_ = 0;
    std::vector<Count> counts_;
    double reach_ = 1.0;
    Parameters priors_;
    Parameters prior_deviations_;
};

}  // namespace gazeloop::statistics
