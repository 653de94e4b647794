#include "drivers/trace/text/cell_number.h"

#include <gtest/gtest.h>

#include <limits>
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
