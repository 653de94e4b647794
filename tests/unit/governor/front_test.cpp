#include "runtime/governor/front.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "runtime/governor/front_file.h"
#include "tests/support/temporary_folder.h"

namespace gazeloop::governor {
namespace {

using testing::HasSubstr;

Front three_levels() {
    return {
        .figure = "contrast",
        .levels = {
            {.method = "full", .ms = 40.0, .loss = 0.25},
            {.method = "kfr",
             .settings = {{"kfr.sigma", "1.8"}, {"kfr.alpha", "4"}},
             .ms = 12.5,
             .loss = 1.0},
            {.method = "acuity", .settings = {{"acuity.mar", "0.034"}}, .ms = 3.0, .loss = 4.0}}};
}

TEST(Front, IsTheSameFromItsTextAndItsFile) {
    const Front front = three_levels();
    const auto from_text = parse_front(front_text(front));
    ASSERT_TRUE(from_text) << from_text.error().message;
    EXPECT_EQ(*from_text, front);
    const tests::TemporaryFolder folder;
    const std::string file = folder / "front.toml";
    std::ofstream(file) << front_file(front, "Made by: a test\non no device");
    const auto from_file = load_front(file);
    ASSERT_TRUE(from_file) << from_file.error().message;
    EXPECT_EQ(*from_file, front);
}

TEST(Front, ThatIsBuiltInIsOne) {
    const auto front = load_front("raymarch");
    ASSERT_TRUE(front) << front.error().message;
    EXPECT_GE(front->levels.size(), 4U);
}

TEST(Front, NamesTheLevelThatIsNoPointOfIt) {
    const auto fault_with = [](const auto& change) {
        Front front = three_levels();
        change(front);
        const auto fault = fault_of(front);
        return fault ? fmt::format("{}: {}", fault->level, fault->message) : std::string();
    };
    EXPECT_EQ(fault_with([](Front&) {}), "");
    EXPECT_THAT(fault_with([](Front& f) { f.levels[1].ms = 40.0; }), HasSubstr("1: kfr kfr.sigma"));
    EXPECT_THAT(fault_with([](Front& f) { f.levels[2].loss = 1.0; }), HasSubstr("2: acuity"));
    EXPECT_THAT(fault_with([](Front& f) { f.levels.clear(); }), HasSubstr("1 to 8 levels"));
    EXPECT_THAT(fault_with([](Front& f) { f.levels.resize(9, f.levels[0]); }),
                HasSubstr("this one 9"));
    EXPECT_THAT(fault_with([](Front& f) { f.figure.clear(); }), HasSubstr("figure = ''"));
    EXPECT_THAT(fault_with([](Front& f) { f.levels[0].method.clear(); }), HasSubstr("method = ''"));
    EXPECT_THAT(fault_with([](Front& f) { f.levels[1].settings[0].second = "0,0;1,1"; }),
                HasSubstr("without commas"));
    for (const double bad : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_THAT(fault_with([&](Front& f) { f.levels[0].ms = bad; }), HasSubstr("0: ms = "));
    }
    EXPECT_THAT(fault_with([](Front& f) { f.levels[0].loss = std::nan(""); }),
                HasSubstr("0: loss = "));
}

TEST(Front, RefusesAFileByItsLine) {
    const tests::TemporaryFolder folder;
    const auto refusal = [&](const std::string& text) {
        const std::string file = folder / "front.toml";
        std::ofstream(file) << text;
        const auto front = load_front(file);
        return front ? std::string() : front.error().message.substr(file.size());
    };
    const std::string good =
        "figure = \"contrast\"\n[[level]]\nmethod = \"kfr\"\nms = 10\nloss = 1\n";
    EXPECT_EQ(refusal(good), "");
    EXPECT_THAT(refusal("figure = \"contrast\"\n"), HasSubstr(":1: a front needs its levels"));
    EXPECT_THAT(refusal(good + "[[level]]\nmethod = \"kfr\"\nms = 11\nloss = 2\n"),
                HasSubstr(":6: kfr (11 ms, loss 2) is no point of a front after kfr"));
    EXPECT_THAT(refusal(good + "speed = 3\n"), HasSubstr(":6: "));
    EXPECT_THAT(refusal(good + "set = \"kfr.sigma\"\n"), HasSubstr("no KEY=VALUE"));
    EXPECT_THAT(refusal(good + "set = 4\n"), HasSubstr(":6: set"));
    EXPECT_THAT(refusal("figure = \"contrast\"\n[[level]]\nmethod = \"kfr\"\nms = nan\nloss = 1\n"),
                HasSubstr(":2: ms = nan"));
    EXPECT_THAT(refusal("figure = \"contrast\"\n[[level]]\nms = 10\nloss = 1\n"),
                HasSubstr(":2: a [[level]] needs method"));
    EXPECT_THAT(refusal("level = 3"), HasSubstr("[[level]]"));
    EXPECT_THAT(refusal("figure = "), HasSubstr(":1: "));
    EXPECT_THAT(load_front((folder / "none.toml").string()).error().message,
                HasSubstr("cannot be read"));
    EXPECT_THAT(load_front("raymrach").error().message, HasSubstr("raymarch"));
}

TEST(Front, RefusesTextThatIsNone) {
    for (const char* const text :
         {"", "contrast", "contrast;", "contrast;kfr", "contrast;kfr,1", "contrast;kfr,x,1",
          "contrast;kfr sigma,1,1", "contrast;kfr,1,1;kfr,2,2", "contrast;kfr,1,1,1", ";;;",
          "contrast;,1,1"}) {
        EXPECT_FALSE(parse_front(text)) << text;
    }
}

}  // namespace
}  // namespace gazeloop::governor
