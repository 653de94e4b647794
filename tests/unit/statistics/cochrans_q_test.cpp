#include "runtime/statistics/cochrans_q.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "runtime/statistics/chi_square.h"

namespace gazeloop::statistics {
namespace {

TEST(ChiSquareTail, IsItsClosedForms) {
    for (double value = 1e-9; value < 1200.0; value *= 1.31) {
        // One degree of freedom: the square of a normal variable; even ones: Poisson sums.
        const double x = value / 2.0;
        EXPECT_NEAR(chi_square_tail(value, 1), std::erfc(std::sqrt(x)), 1e-13) << value;
        EXPECT_NEAR(chi_square_tail(value, 2), std::exp(-x), 1e-13) << value;
        EXPECT_NEAR(chi_square_tail(value, 3),
                    std::erfc(std::sqrt(x)) + std::sqrt(4.0 * x / std::numbers::pi) * std::exp(-x),
                    1e-12)
            << value;
        double term = std::exp(-x);
        double sum = term;
        for (int n = 1; n < 50; ++n) {
            term *= x / n;
            sum += term;
        }
        EXPECT_NEAR(chi_square_tail(value, 100), sum, 1e-12) << value;
    }
    // Far out it keeps its digits.
    EXPECT_NEAR(chi_square_tail(400.0, 2) / std::exp(-200.0), 1.0, 1e-10);
    // The usual critical values.
    EXPECT_NEAR(chi_square_tail(3.841459, 1), 0.05, 1e-7);
    EXPECT_NEAR(chi_square_tail(7.814728, 3), 0.05, 1e-7);
}

TEST(ChiSquareTail, HoldsAtItsEnds) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(chi_square_tail(0.0, 3), 1.0);
    EXPECT_EQ(chi_square_tail(-5.0, 3), 1.0);
    EXPECT_EQ(chi_square_tail(kInfinity, 3), 0.0);
    EXPECT_EQ(chi_square_tail(std::numeric_limits<double>::max(), 3), 0.0);
    EXPECT_EQ(chi_square_tail(std::numeric_limits<double>::denorm_min(), 3), 1.0);
    EXPECT_TRUE(std::isnan(chi_square_tail(std::numeric_limits<double>::quiet_NaN(), 3)));
    const double many = chi_square_tail(100'000.0, 100'000);
    EXPECT_NEAR(many, 0.5, 0.01);
}

// Meng et al. 2018, table 1: four kernels (alpha 1 to 4) at seven sigmas.
TEST(CochransQ, GivesThePublishedPs) {
    struct Row {
        double sigma_squared;
        double q;
        double p;
    };
    constexpr std::array kTable{Row{1.44, 1.72, 0.631}, Row{1.96, 5.79, 0.122},
                                Row{2.56, 8.20, 0.042}, Row{3.24, 8.25, 0.041},
                                Row{4.00, 7.49, 0.058}, Row{4.84, 14.27, 0.002},
                                Row{5.76, 5.48, 0.139}};
    constexpr std::size_t kKernels = 4;
    for (const Row& row : kTable) {
        // Q is printed to .01; the paper cuts its ps where it could round them.
        EXPECT_NEAR(p_of_cochrans_q(row.q, kKernels), row.p, 0.0015) << row.sigma_squared;
    }
    // Its threshold of significance, printed as chi-square(3) = 7.81.
    EXPECT_NEAR(p_of_cochrans_q(7.81, kKernels), 0.05, 2e-4);
}

// By hand: C = 4 3 1, R = 2 1 2 3, T = 8. Q = 2 (3 * 26 - 64) / (24 - 18) = 14/3.
TEST(CochransQ, IsItsFormula) {
    const auto result =
        cochrans_q({.treatments = 3, .answers = {1, 1, 0, 1, 0, 0, 1, 1, 0, 1, 1, 1}});
    ASSERT_TRUE(result);
    EXPECT_NEAR(result->q, 14.0 / 3.0, 1e-12);
    EXPECT_EQ(result->degrees_of_freedom, 2U);
    EXPECT_NEAR(result->p, std::exp(-7.0 / 3.0), 1e-12);
}

// Of two treatments it is McNemar's test: (b - c)^2 / (b + c).
TEST(CochransQ, OfTwoIsMcNemars) {
    BinaryAnswers answers{.treatments = 2, .answers = {}};
    const auto add = [&](int times, std::uint8_t first, std::uint8_t second) {
        for (int i = 0; i < times; ++i) {
            answers.answers.push_back(first);
            answers.answers.push_back(second);
        }
    };
    add(9, 1, 0);
    add(2, 0, 1);
    add(30, 1, 1);
    add(5, 0, 0);
    EXPECT_NEAR(cochrans_q(answers)->q, 49.0 / 11.0, 1e-12);
}

// Where all treatments are alike, one in twenty studies calls them different at 5 %.
TEST(CochransQ, IsRarelyFooled) {
    std::mt19937 random(3);
    int fooled = 0;
    constexpr int kStudies = 2000;
    for (int study = 0; study < kStudies; ++study) {
        BinaryAnswers answers{.treatments = 4, .answers = {}};
        for (int subject = 0; subject < 40; ++subject) {
            const auto inclination = random() % 10;
            for (int treatment = 0; treatment < 4; ++treatment) {
                answers.answers.push_back(random() % 10 < inclination ? 1 : 0);
            }
        }
        fooled += cochrans_q(answers)->p < 0.05 ? 1 : 0;
    }
    EXPECT_GT(fooled, kStudies * 3 / 100);
    EXPECT_LT(fooled, kStudies * 7 / 100);
}

TEST(CochransQ, SaysNothingOfNothing) {
    EXPECT_FALSE(cochrans_q({}));
    EXPECT_FALSE(cochrans_q({.treatments = 1, .answers = {1, 0}}));
    EXPECT_FALSE(cochrans_q({.treatments = 3, .answers = {1, 0}}));
    EXPECT_FALSE(cochrans_q({.treatments = 2, .answers = {}}));
    EXPECT_FALSE(cochrans_q({.treatments = 2, .answers = {1, 1, 0, 0}}));
}

}  // namespace
}  // namespace gazeloop::statistics
