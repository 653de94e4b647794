#include "runtime/statistics/posterior_draws.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "runtime/statistics/distributions.h"

namespace gazeloop::statistics {
namespace {

using Vector = PeoplePosterior::Parameters;
using Square = PeoplePosterior::Square;

constexpr int kDegrees = 5;  // tails heavier than the posterior's, or few weights would rule
constexpr int kStages = 3;
constexpr std::size_t kLeastDraws = 30;
constexpr double kFirstVariance = 1.5;
/// How many draws what a stage began with counts as: few weights make no covariance.
constexpr double kBefore = 12.0;

double normal(std::mt19937_64& random) {
    return normal_quantile((static_cast<double>(random() >> 12U) + 0.5) * 0x1p-52);
}

/// Student's distribution of several dimensions, about 0 and of scale 1.
Vector student(std::mt19937_64& random) {
    double squares = 0.0;
    for (int i = 0; i < kDegrees; ++i) {
        const double one = normal(random);
        squares += one * one;
    }
    Vector draw;
    for (double& one : draw) {
        one = normal(random);
    }
    return draw * std::sqrt(kDegrees / squares);
}

double log_density(const Vector& draw) {
    return -0.5 * (kDegrees + static_cast<double>(draw.size())) *
           std::log1p(draw.squaredNorm() / kDegrees);
}

/// From logarithms; they sum to 1 afterwards. What is no number weighs nothing.
void normalise(std::vector<PosteriorDraw>& draws) {
    double greatest = -std::numeric_limits<double>::infinity();
    for (const PosteriorDraw& one : draws) {
        greatest = std::max(greatest, one.weight);
    }
    double sum = 0.0;
    for (PosteriorDraw& one : draws) {
        one.weight = one.weight <= greatest ? std::exp(one.weight - greatest) : 0.0;
        sum += one.weight;
    }
    for (PosteriorDraw& one : draws) {
        one.weight /= sum;
    }
}

}  // namespace

std::vector<PosteriorDraw> draw_posterior(const PeoplePosterior& posterior, const Vector& best,
                                          std::uint64_t seed, std::size_t draws) {
    std::mt19937_64 random(seed);
    Vector middle = best;
    Square covariance =
        kFirstVariance * posterior.information(best).llt().solve(Square::Identity());
    std::vector<PosteriorDraw> drawn(std::max(draws, kLeastDraws) / kStages);
    for (int stage = 0; stage < kStages; ++stage) {
        const Square scale = covariance.llt().matrixL();
        for (PosteriorDraw& one : drawn) {
            const Vector off = student(random);
            one.parameters = middle + scale * off;
            // A logarithm, until all are known.
            one.weight = posterior.logarithm(one.parameters) - log_density(off);
        }
        normalise(drawn);
        Vector mean = Vector::Zero();
        double squares = 0.0;
        for (const PosteriorDraw& one : drawn) {
            mean += one.weight * one.parameters;
            squares += one.weight * one.weight;
        }
        Square found = Square::Zero();
        for (const PosteriorDraw& one : drawn) {
            const Vector off = one.parameters - mean;
            found += one.weight * off * off.transpose();
        }
        const double share = 1.0 / (1.0 + kBefore * squares);  // 1 / squares draws are worth it
        covariance = share * found + (1.0 - share) * covariance;
        middle = share * mean + (1.0 - share) * middle;
    }
    return drawn;
}

}  // namespace gazeloop::statistics
