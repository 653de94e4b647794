#include "drivers/trace/text/cell_number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>

namespace gazeloop::drivers {
namespace {

std::optional<double> real(std::string_view cell) {
    NumberSpelling seen;
    return real_number(cell, seen);
}

std::optional<std::int64_t> whole(std::string_view cell) {
    NumberSpelling seen;
    return whole_number(cell, seen);
}

std::optional<std::int64_t> decimal(std::string_view cell, int digits) {
    NumberSpelling seen;
    return decimal_number(cell, digits, seen);
}

TEST(DecimalNumber, IsExactAndRounded) {
    EXPECT_EQ(decimal("0.006684", 9), 6'684'000);
    EXPECT_EQ(decimal("-1.5", 9), -1'500'000'000);
    EXPECT_EQ(decimal("1700000000.123456789", 9), 1'700'000'000'123'456'789) << "no double has it";
    EXPECT_EQ(decimal("12", 6), 12'000'000);
    EXPECT_EQ(decimal("+.5", 3), 500);
    EXPECT_EQ(decimal("7.", 1), 70);
    EXPECT_EQ(decimal("0.0005", 3), 1) << "rounded by the first digit behind";
    EXPECT_EQ(decimal("0.00049999", 3), 0);
    EXPECT_EQ(decimal("-0.0005", 3), -1);
    EXPECT_EQ(decimal("2.5", 0), 3);
    EXPECT_EQ(decimal("1.5E-3", 9), 1'500'000);
    EXPECT_EQ(decimal("9223372036854775799", 0), 9'223'372'036'854'775'799);
    NumberSpelling seen;
    EXPECT_EQ(decimal_number("1,25", 2, seen), 125);
    EXPECT_TRUE(seen.decimal_comma);
}

TEST(DecimalNumber, RefusesWhatIsNoneOrDoesNotFit) {
    for (const std::string_view cell :
         {"", "-", "+", ".", "abc", "1.2.3", "1,2,3", "1 2", "nan", "inf", "n/a", "--1", "+-1",
          "e5", "1e99", "1e", "99999999999", "12345678901234567890"}) {
        EXPECT_FALSE(decimal(cell, 9)) << cell;
    }
}

TEST(RealNumber, ReadsPointsAndCommas) {
    NumberSpelling seen;
    EXPECT_EQ(real_number("-0.25", seen), -0.25);
    EXPECT_EQ(real_number("1e-3", seen), 0.001);
    EXPECT_EQ(real_number("+.5", seen), 0.5);
    EXPECT_FALSE(seen.decimal_comma);
    EXPECT_EQ(real_number("-0,25", seen), -0.25);
    EXPECT_TRUE(seen.decimal_comma);
    EXPECT_EQ(real("1,5e3"), 1500.0);
    EXPECT_EQ(real("5e-324"), std::numeric_limits<double>::denorm_min());
}

/// Short ones go another way than long ones.
TEST(RealNumber, IsTheNearestDoubleHoweverLong) {
    std::mt19937_64 random(3);
    for (int i = 0; i < 20'000; ++i) {
        const std::uint64_t digits = random() % 1'000'000'000'000'000'000U;
        std::string cell = std::to_string(digits).substr(0, 1 + i % 18);
        cell.insert(random() % (cell.size() + 1), ".");
        cell = (i % 2 == 0 ? "-" : "") + cell;
        ASSERT_EQ(real(cell), std::strtod(cell.c_str(), nullptr)) << cell;
    }
    EXPECT_TRUE(std::signbit(real("-0").value()));
}

TEST(RealNumber, RefusesWhatIsNone) {
    for (const std::string_view cell :
         {"",      "abc",       "1 2", "0x1", "1.2.3", "1,234.5",  "1,2,3",
          "1e999", "+-1",       "++1", "+",   "-",     ",",        ".",
          "nan",   "-nan(ind)", "NaN", "inf", "-inf",  "infinity", "n/a"}) {
        EXPECT_FALSE(real(cell)) << cell;
    }
    EXPECT_FALSE(real("0," + std::string(100, '1'))) << "too long for a comma";
}

TEST(WholeNumber, ReadsAllDigits) {
    EXPECT_EQ(whole("638342794000115346"), 638'342'794'000'115'346);
    EXPECT_EQ(whole("-9223372036854775808"), std::numeric_limits<std::int64_t>::min());
    EXPECT_EQ(whole("+7"), 7);
}

TEST(WholeNumber, ReadsZerosBehindAPointExactly) {
    NumberSpelling seen;
    EXPECT_EQ(whole_number("31", seen), 31);
    EXPECT_FALSE(seen.whole_as_real);
    // Through a double this would end in 344.
    EXPECT_EQ(whole_number("638342794000115346.0", seen), 638'342'794'000'115'346);
    EXPECT_TRUE(seen.whole_as_real);
    EXPECT_FALSE(seen.decimal_comma);
    EXPECT_EQ(whole_number("31,00", seen), 31);
    EXPECT_TRUE(seen.decimal_comma);
}

TEST(WholeNumber, RefusesWhatIsNone) {
    for (const std::string_view cell :
         {"", "12.5", "1e3", "99999999999999999999", "1 2", "nan", "1.7E+18", "a"}) {
        EXPECT_FALSE(whole(cell)) << cell;
    }
    NumberSpelling seen;
    EXPECT_FALSE(count_number("-1", seen));
    EXPECT_EQ(count_number("18446744073709551615", seen),
              std::numeric_limits<std::uint64_t>::max());
}

TEST(SaysNoNumber, KnowsTheWordsThatProgramsWrite) {
    for (const std::string_view cell :
         {"", "NaN", "nan", "-nan(ind)", "-nan", "nan(snan)", "inf", "-INF", "Infinity", "n/a",
          "N/A", "NA", "null", "None", "-", ".", "-1.#IND", "1.#QNAN"}) {
        EXPECT_TRUE(says_no_number(cell)) << cell;
    }
    for (const std::string_view cell : {"0", "abc", "-1", "1e999", "information", "0.5", "-0"}) {
        EXPECT_FALSE(says_no_number(cell)) << cell;
    }
}

}  // namespace
}  // namespace gazeloop::drivers
