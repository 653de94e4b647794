#include "runtime/trade/fitted_shape.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "runtime/foveation/log_polar/table_kernel.h"
#include "runtime/trade/lp_shape.h"
#include "runtime/trade/pattern_search.h"

namespace gazeloop::trade {
namespace {

using testing::HasSubstr;

TEST(PatternSearch, FindsTheBottomOfABowl) {
    unsigned asked = 0;
    const auto bowl = [&](std::span<const std::vector<double>> places) {
        std::vector<double> losses;
        for (const std::vector<double>& at : places) {
            losses.push_back(std::pow(at[0] - 2.0, 2.0) + 3.0 * std::pow(at[1] + 1.0, 2.0) +
                             0.5 * at[0] * at[1]);
            ++asked;
        }
        return Expected<std::vector<double>>(std::move(losses));
    };
    const auto best =
        pattern_search({.start = {0.0, 0.0}, .step = 1.0, .least_step = 1e-4}, bowl).value();
    // Where both derivatives are 0: 2 (x - 2) + y / 2 = 0, 6 (y + 1) + x / 2 = 0.
    EXPECT_NEAR(best.place[0], 54.0 / 23.5, 1e-3);
    EXPECT_NEAR(best.place[1], -28.0 / 23.5, 1e-3);
    EXPECT_LT(asked, 200U);
}

TEST(PatternSearch, StaysWhereNothingIsBetter) {
    const double infinite = std::numeric_limits<double>::infinity();
    for (const double everywhere : {1.0, infinite}) {
        const auto best =
            pattern_search({.start = {3.0}}, [&](std::span<const std::vector<double>> places) {
                return Expected<std::vector<double>>(
                    std::vector<double>(places.size(), everywhere));
            }).value();
        EXPECT_EQ(best.place, std::vector<double>{3.0});
        EXPECT_EQ(best.loss, everywhere);
    }
    const auto failed = pattern_search({.start = {3.0}}, [](auto) {
        return Expected<std::vector<double>>(
            std::unexpected(Error{ErrorKind::Interrupted, "stopped"}));
    });
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().kind, ErrorKind::Interrupted);
}

std::vector<foveation::TableKernel::Sample> samples_of(const LpShape& shape) {
    const auto y = shape.rises();
    return {{0.0, 0.0}, {0.25, y[0]}, {0.5, y[1]}, {0.75, y[2]}, {1.0, 1.0}};
}

TEST(LpShape, IsThePowerKernelWhereItStarts) {
    for (const double alpha : {1.0, 2.0, 4.0}) {
        const LpShape shape = LpShape::power(0.35, alpha);
        EXPECT_NEAR(shape.aspect(), 0.35, 1e-12);
        for (std::size_t q = 0; q < 3; ++q) {
            EXPECT_NEAR(shape.rises()[q], std::pow(0.25 * static_cast<double>(q + 1), alpha),
                        1e-12);
        }
        const auto kernel = foveation::TableKernel::create(samples_of(shape));
        ASSERT_TRUE(kernel);
        EXPECT_NEAR((*kernel)(0.6), std::pow(0.6, alpha), 0.02);
    }
}

// A search may go anywhere, and every place is a kernel.
TEST(LpShape, IsAKernelEverywhere) {
    for (const double a : {-1e9, -5.0, 0.0, 5.0, 1e9}) {
        for (const double b : {-1e9, 0.0, 1e9}) {
            const LpShape shape = LpShape::of(std::array{0.0, a, b, -a});
            const auto kernel = foveation::TableKernel::create(samples_of(shape));
            EXPECT_TRUE(kernel) << a << ' ' << b;
        }
    }
}

TEST(FittedShape, IsWrittenAsSettings) {
    SweepQuestion question;
    question.display = "a display";
    question.comparison.view.width_px = 100;
    question.comparison.view.height_px = 80;
    question.cases = {{.scene = "raymarch", .gaze = "0,0", .directions = {{}, {}}}};
    const FittedShape fitted{.before = {.method = "interleaved", .settings = {{"kfr.sigma", "2"}}},
                             .after = {.method = "interleaved",
                                       .settings = {{"kfr.sigma", "2.5"},
                                                    {"interleaved.every", "8"},
                                                    {"kfr.aspect", "0.4"},
                                                    {"kfr.kernel", "table"},
                                                    {"kfr.kernel_samples", "0,0;0.5,0.1;1,1"}}},
                             .loss_before = 0.7,
                             .loss_after = 0.6,
                             .tried = 3};
    const std::string toml =
        fitted_toml(fitted, {.method = "interleaved", .fewer = 20.0}, question, "gazeloop trade");
    EXPECT_THAT(toml, HasSubstr("# Made by: gazeloop trade\n# a display, 100x80 px an eye, 2 "
                                "frames, 1 sample per cell;"));
    EXPECT_THAT(toml,
                HasSubstr("At 20 times fewer samples than pixels (in a frame that follows others) "
                          "the first figure is 0.6, 0.7 with kfr.sigma=2."));
    EXPECT_THAT(toml, HasSubstr("\n[interleaved]\nevery = \"8\"\n"));
    EXPECT_THAT(toml, HasSubstr("\n[kfr]\nsigma = 2.5\naspect = 0.4\nkernel = \"table\"\n"
                                "kernel_samples = \"0,0;0.5,0.1;1,1\"\n"));
    EXPECT_THAT(toml, HasSubstr("\n[render]\nmethod = \"interleaved\"\n"));
}

}  // namespace
}  // namespace gazeloop::trade
