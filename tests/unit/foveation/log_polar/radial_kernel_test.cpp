#include "runtime/foveation/log_polar/radial_kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "runtime/methods/kernel_table_file.h"
#include "tests/unit/foveation/log_polar/every_kernel.h"

namespace gazeloop::foveation {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(RadialKernel, RisesFromZeroToOneAndInverts) {
    for (const RadialKernel& kernel : every_kernel()) {
        SCOPED_TRACE(kernel.description());
        EXPECT_EQ(kernel(0.0), 0.0);
        EXPECT_EQ(kernel(1.0), 1.0);
        EXPECT_EQ(kernel.inverse(0.0), 0.0);
        EXPECT_NEAR(kernel.inverse(1.0), 1.0, 1e-15);
        double before = 0.0;
        for (int i = 1; i <= 1000; ++i) {
            const double x = i / 1000.0;
            const double y = kernel(x);
            ASSERT_GE(y, before) << x;
            before = y;
            // Where K is steep, y is not known better than x's rounding allows.
            const double inverse = kernel.inverse(x);
            ASSERT_NEAR(kernel(inverse), x, 1e-12 + 1e-15 * kernel.derivative(inverse)) << x;
            // Where K is flat, x is not known better than K's rounding allows.
            const double flat = kernel.derivative(x);
            ASSERT_NEAR(kernel.inverse(y), x, flat > 1e-3 ? 1e-12 / flat : 1e-2) << x;
        }
    }
}

TEST(RadialKernel, HasItsOwnDerivative) {
    for (const RadialKernel& kernel : every_kernel()) {
        SCOPED_TRACE(kernel.description());
        for (const double x : {0.1, 0.29, 0.45, 0.7, 0.9}) {
            const double h = 1e-6;
            EXPECT_NEAR(kernel.derivative(x), (kernel(x + h) - kernel(x - h)) / (2 * h),
                        1e-4 * (1.0 + kernel.derivative(x)));
        }
    }
}

TEST(RadialKernel, IsWhatThePapersName) {
    EXPECT_DOUBLE_EQ(RadialKernel(4.0)(0.5), 0.0625);
    EXPECT_DOUBLE_EQ(RadialKernel(PrintedPowerKernel{4.0})(0.0625), 0.5);
    EXPECT_DOUBLE_EQ(RadialKernel(SineKernel{})(1.0 / 3.0), 0.5);
    EXPECT_DOUBLE_EQ(RadialKernel(ExponentialKernel{})(0.5),
                     (std::exp(0.5) - 1.0) / (std::numbers::e - 1.0));
    EXPECT_DOUBLE_EQ(
        RadialKernel(PolynomialKernel::create(std::vector{0.5, 0.0, 0.5}).value())(0.5), 0.3125);
}

struct Polynomial {
    const char* name;
    std::vector<double> coefficients;
    const char* message;
};
void PrintTo(const Polynomial& at, std::ostream* out) { *out << at.name; }
class PolynomialRefuses : public testing::TestWithParam<Polynomial> {};

TEST_P(PolynomialRefuses, WithTheValueAndTheRange) {
    const auto kernel = PolynomialKernel::create(GetParam().coefficients);
    ASSERT_FALSE(kernel.has_value());
    EXPECT_EQ(kernel.error().kind, ErrorKind::Usage);
    EXPECT_NE(kernel.error().message.find(GetParam().message), std::string::npos)
        << kernel.error().message;
}

INSTANTIATE_TEST_SUITE_P(
    BadInput, PolynomialRefuses,
    testing::Values(
        Polynomial{"none", {}, "0 coefficients: it must have 1 to 12"},
        Polynomial{"too_many", std::vector<double>(13, 1.0 / 13), "13 coefficients"},
        Polynomial{"not_a_number", {0.5, kNan}, "nan of x^2: must lie in [-1000, 1000]"},
        Polynomial{"infinite", {kInfinity}, "inf of x^1"},
        Polynomial{"too_large", {1001.0, -1000.0}, "1001 of x^1"},
        Polynomial{"sum", {0.5, 0.6}, "sum to 1.1: the sum must lie in [0.999999, 1.000001]"},
        Polynomial{"falls_at_the_start", {-1.0, 2.0}, "falls at x = 0"},
        Polynomial{"falls_at_the_end", {3.0, -2.0}, "falls at x = 1"},
        // The slope, 1 + 1e-9 - 4 x + 4 x^2 shifted down, dips below 0 around 1/2 alone.
        Polynomial{"falls_in_the_middle", {3.01, -6.02, 4.01}, "falls at x ="}),
    [](const auto& instance) { return instance.param.name; });

TEST(Polynomial, AcceptsAFlatPointAndNoDip) {
    // Slope 3 (2x - 1)^2: it touches zero at 1/2.
    EXPECT_TRUE(PolynomialKernel::create(std::vector{3.0, -6.0, 4.0}).has_value());
    // A dip of 1e-6 around 1/2, a thousandth wide.
    EXPECT_FALSE(
        PolynomialKernel::create(std::vector{3.0 - 1e-6, -6.0 + 1e-7, 4.0 + 9e-7}).has_value());
    // The dip at 1/3 of a fourth power's slope.
    const auto slope_at_third = [](double depth) {
        // integral of (x - 1/3)^2 - depth, scaled to the sum 1
        const double a = 1.0 / 9.0 - depth;
        const double sum = a - 1.0 / 3.0 + 1.0 / 3.0;
        return std::vector{a / sum, -1.0 / 3.0 / sum, 1.0 / 3.0 / sum};
    };
    EXPECT_TRUE(PolynomialKernel::create(slope_at_third(0.0)).has_value());
    EXPECT_TRUE(PolynomialKernel::create(slope_at_third(-1e-9)).has_value());
    EXPECT_FALSE(PolynomialKernel::create(slope_at_third(1e-9)).has_value());
}

TEST(TableKernel, PassesThroughItsSamplesWithoutOvershoot) {
    const std::vector<TableKernel::Sample> samples{
        {0, 0}, {0.2, 0.01}, {0.21, 0.7}, {0.9, 0.71}, {1, 1}};
    const TableKernel kernel = TableKernel::create(samples).value();
    for (const auto& [x, y] : samples) {
        EXPECT_NEAR(kernel(x), y, 1e-15);
        EXPECT_NEAR(kernel.inverse(y), x, 1e-12);
    }
    for (std::size_t i = 1; i < samples.size(); ++i) {
        for (double t = 0.0; t <= 1.0; t += 0.01) {
            const double y = kernel(std::lerp(samples[i - 1].x, samples[i].x, t));
            EXPECT_GE(y, samples[i - 1].y - 1e-15);
            EXPECT_LE(y, samples[i].y + 1e-15);
        }
    }
}

struct TableText {
    const char* name;
    bool toml;
    const char* text;
    const char* message;  ///< null: it is good
};
void PrintTo(const TableText& at, std::ostream* out) { *out << at.name; }
class KernelTableFile : public testing::TestWithParam<TableText> {};

TEST_P(KernelTableFile, IsReadOrRefusedWithFileAndLine) {
    std::istringstream in(GetParam().text);
    const auto kernel = methods::read_kernel_table(in, "k", GetParam().toml);
    ASSERT_EQ(kernel.has_value(), GetParam().message == nullptr)
        << (kernel ? "" : kernel.error().message);
    if (!kernel) {
        EXPECT_EQ(kernel.error().kind, ErrorKind::BadInput);
        EXPECT_NE(kernel.error().message.find(GetParam().message), std::string::npos)
            << kernel.error().message;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Texts, KernelTableFile,
    testing::Values(
        TableText{"csv", false, "# mine\nx,y\n0,0\n\n 0.5 , 0.1\r\n1,1\n", nullptr},
        TableText{"csv_without_names", false, "0,0\n1,1", nullptr},
        TableText{"toml", true, "kernel = [[0, 0], [0.5, 0.1],\n [1, 1]]\n", nullptr},
        TableText{"empty", false, "", "k:1: a kernel's table of 0 samples: it must have 2 to 4096"},
        TableText{"word", false, "0,0\n0.5,half\n1,1", "k:2: '0.5,half': two numbers"},
        TableText{"one_number", false, "0,0\n0.5\n1,1", "k:2: '0.5'"},
        TableText{"not_a_number", false, "0,0\nnan,0.5\n1,1", "k:2: (nan, 0.5)"},
        TableText{"out_of_range", false, "0,0\n0.5,1.5\n1,1", "k:2: (0.5, 1.5): both must lie"},
        TableText{"falls", false, "0,0\n0.5,0.6\n0.6,0.5\n1,1", "k:3: (0.6, 0.5) follows"},
        TableText{"stays", false, "0,0\n0.5,0.6\n0.6,0.6\n1,1", "k:3: (0.6, 0.6) follows"},
        TableText{"start", false, "0.1,0\n1,1", "k:1: (0.1, 0): the first"},
        TableText{"end", false, "0,0\n\n1,0.9", "k:3: (1, 0.9): the last"},
        TableText{"toml_pair", true, "kernel = [[0, 0],\n [1]]", "k:2: a pair"},
        TableText{"toml_text", true, "kernel = [[0, 0],\n [1, 'one']]", "k:2: a pair"},
        TableText{"toml_falls", true, "kernel = [[0, 0],\n[0.5, 0.5],\n[0.4, 0.6], [1, 1]]",
                  "k:3: (0.4, 0.6)"},
        TableText{"toml_none", true, "kernels = 1", "an array kernel"},
        TableText{"toml_broken", true, "kernel = [\n[0", "k:2"}),
    [](const auto& instance) { return instance.param.name; });

TEST(KernelTableFile, IsTheSameToTheBitAsSamplesInALine) {
    std::istringstream in("0,0\n0.1,1e-05\n0.30000000000000004,0.3333333333333333\n1,1\n");
    const TableKernel kernel = methods::read_kernel_table(in, "k", false).value();
    const std::string line = methods::kernel_samples(kernel);
    EXPECT_EQ(line, "0,0;0.1,1e-05;0.30000000000000004,0.3333333333333333;1,1");
    const TableKernel again = methods::read_kernel_samples(line, "line").value();
    for (double x = 0.0; x <= 1.0; x += 1.0 / 64.0) {
        EXPECT_EQ(again(x), kernel(x)) << x;
    }
    EXPECT_EQ(methods::read_kernel_samples("0,0;1", "line").error().message,
              "line:2: '1': two numbers x,y are expected");
}

TEST(KernelTableFile, NamesAFileThatIsNotThere) {
    const auto kernel = methods::load_kernel_table("/nowhere/kernel.csv");
    ASSERT_FALSE(kernel.has_value());
    EXPECT_NE(kernel.error().message.find("/nowhere/kernel.csv"), std::string::npos);
    EXPECT_FALSE(methods::load_kernel_table("/tmp").has_value());
}

}  // namespace
}  // namespace gazeloop::foveation
