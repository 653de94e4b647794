#include "runtime/statistics/proportion.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "runtime/statistics/distributions.h"

namespace gazeloop::statistics {
namespace {

TEST(NormalQuantile, InvertsTheShare) {
    for (double share = 1e-300; share < 0.5; share *= 7.3) {
        EXPECT_NEAR(normal_share(normal_quantile(share)) / share, 1.0, 1e-11) << share;
    }
    EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-12);
    EXPECT_NEAR(normal_quantile(0.5), 0.0, 1e-12);
    EXPECT_EQ(normal_quantile(0.0), -std::numeric_limits<double>::infinity());
    EXPECT_EQ(normal_quantile(1.0), std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::isnan(normal_quantile(-0.1)));
    EXPECT_TRUE(std::isnan(normal_quantile(std::nan(""))));
    EXPECT_TRUE(std::isfinite(normal_quantile(std::numeric_limits<double>::denorm_min())));
}

TEST(StudentQuantile, IsTheTables) {
    // Closed forms of one and two degrees of freedom, then the usual table.
    EXPECT_NEAR(student_quantile(0.975, 1), std::tan(std::numbers::pi * 0.475), 1e-8);
    EXPECT_NEAR(student_quantile(0.975, 2), 0.95 * std::sqrt(2.0 / (1.0 - 0.95 * 0.95)), 1e-8);
    EXPECT_NEAR(student_quantile(0.975, 3), 3.182446, 1e-6);
    EXPECT_NEAR(student_quantile(0.95, 7), 1.894579, 1e-6);
    EXPECT_NEAR(student_quantile(0.975, 17), 2.109816, 1e-6);
    EXPECT_NEAR(student_quantile(0.975, 100'000), normal_quantile(0.975), 1e-4);
    EXPECT_NEAR(student_quantile(0.5, 4), 0.0, 1e-9);
    EXPECT_TRUE(std::isnan(student_quantile(1.0, 4)));
}

TEST(Wilson, HoldsWhereEachBoundIsJustRejected) {
    for (const std::uint64_t trials : {1U, 2U, 10U, 168U}) {
        for (std::uint64_t yes = 0; yes <= trials; yes += trials > 20 ? 7 : 1) {
            const Proportion one = wilson_interval(yes, trials);
            const double z = normal_quantile(0.975);
            const auto n = static_cast<double>(trials);
            for (const double bound : {one.low, one.high}) {
                if (bound > 0.0 && bound < 1.0) {  // (p - bound)^2 = z^2 bound (1 - bound) / n
                    EXPECT_NEAR(std::abs(one.share - bound), z * std::sqrt(bound * (1 - bound) / n),
                                1e-12);
                }
            }
            EXPECT_LE(one.low, one.share);
            EXPECT_GE(one.high, one.share);
        }
    }
    EXPECT_EQ(wilson_interval(0, 5).low, 0.0);
    EXPECT_EQ(wilson_interval(5, 5).high, 1.0);
    const Proportion none = wilson_interval(0, 0);
    EXPECT_TRUE(std::isnan(none.share));
    EXPECT_EQ(none.low, 0.0);
    EXPECT_EQ(none.high, 1.0);
}

TEST(McNemar, IsTheBinomialsTails) {
    EXPECT_NEAR(mcnemar_p(3, 12), 2.0 * (1 + 15 + 105 + 455) / 32768.0, 1e-12);
    EXPECT_NEAR(mcnemar_p(12, 3), mcnemar_p(3, 12), 1e-15);
    EXPECT_NEAR(mcnemar_p(0, 5), 2.0 / 32.0, 1e-13);
    EXPECT_EQ(mcnemar_p(0, 0), 1.0);
    EXPECT_EQ(mcnemar_p(4, 4), 1.0);
    EXPECT_NEAR(mcnemar_p(0, 500), 0.0, 1e-100);
}

TEST(Holm, RaisesInStepsAndNeverLetsAGreaterPPass) {
    const std::array<double, 4> p{0.01, 0.04, 0.03, 0.005};
    const std::vector<double> raised = holm(p);
    EXPECT_NEAR(raised[3], 0.02, 1e-15);
    EXPECT_NEAR(raised[0], 0.03, 1e-15);
    EXPECT_NEAR(raised[2], 0.06, 1e-15);
    EXPECT_NEAR(raised[1], 0.06, 1e-15);  // 0.04 alone, but not below the one before
    EXPECT_TRUE(holm({}).empty());
    EXPECT_EQ(holm(std::array<double, 2>{0.9, 0.8})[0], 1.0);
}

}  // namespace
}  // namespace gazeloop::statistics
