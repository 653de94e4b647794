#include "drivers/trace/text/line_cells.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gazeloop::drivers {
namespace {

using ::testing::ElementsAre;
using Problem = LineCells::Problem;

class SplitLine : public ::testing::Test {
  protected:
    std::vector<std::string> split(std::string_view line, char separator = ',') {
        problem_ = cells_.split(line, separator);
        return {cells_.cells().begin(), cells_.cells().end()};
    }

    LineCells cells_{1000};
    Problem problem_ = Problem::None;
};

TEST_F(SplitLine, TakesPlainCellsWithoutSpacesAroundThem) {
    EXPECT_THAT(split("a, b c ,,\td"), ElementsAre("a", "b c", "", "d"));
    EXPECT_THAT(split(""), ElementsAre(""));
    EXPECT_THAT(split("a\t\tb", '\t'), ElementsAre("a", "", "b"));
    EXPECT_FALSE(cells_.had_quotes());
}

TEST_F(SplitLine, TakesCellsOutOfQuotes) {
    EXPECT_THAT(split(R"("a";  "b;c" ;"d ""e"" f";"";" g ";h)", ';'),
                ElementsAre("a", "b;c", R"(d "e" f)", "", "g", "h"));
    EXPECT_EQ(problem_, Problem::None);
    EXPECT_TRUE(cells_.had_quotes());
    EXPECT_THAT(split(R"(x,"")"), ElementsAre("x", ""));
    EXPECT_THAT(split(R"("""",y)"), ElementsAre(R"(")", "y"));
}

TEST_F(SplitLine, KeepsCellsOfALongLineInTheirPlace) {
    std::string line;
    std::vector<std::string> expected;
    for (int i = 0; i < 100; ++i) {
        line += (i > 0 ? "," : "") + ("\"c" + std::to_string(i)) + '"';
        expected.push_back("c" + std::to_string(i));
    }
    EXPECT_EQ(split(line), expected);
}

TEST_F(SplitLine, TakesAQuoteWithinACellAsItIs) {
    EXPECT_THAT(split(R"(5" screen,a"b")"), ElementsAre(R"(5" screen)", R"(a"b")"));
    EXPECT_FALSE(cells_.had_quotes());
}

TEST_F(SplitLine, SaysWhatIsWrongWithQuotes) {
    EXPECT_THAT(split(R"(a,"b,c)"), ElementsAre("a"));
    EXPECT_EQ(problem_, Problem::OpenQuote);
    (void)split(R"("a"b,c)");
    EXPECT_EQ(problem_, Problem::TextBehindQuote);
    (void)split("a,b");
    EXPECT_EQ(problem_, Problem::None);
}

TEST(CountOutsideQuotes, LeavesOutWhatIsQuoted) {
    EXPECT_EQ(count_outside_quotes(R"(a;"b;c;""d;";e)", ';'), 2U);
    EXPECT_EQ(count_outside_quotes("", ';'), 0U);
}

}  // namespace
}  // namespace gazeloop::drivers
