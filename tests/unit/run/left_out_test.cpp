#include "runtime/run/left_out.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <vector>

namespace gazeloop::run {
namespace {

using testing::HasSubstr;
using testing::Not;

latency::SummaryReport of_three_frames() {
    latency::SummaryReport report{};
    report.config.passes = {"shadow", "defer", "resolve"};
    report.frames.rendered = 3;
    const auto row = [&](std::size_t pass, std::uint64_t count, double ms) {
        report.passes.at(pass).count = count;
        report.passes.at(pass).max_ms = ms;
    };
    row(0, 1, 31.25);
    row(1, 3, 8.0);
    row(2, 1, 2.0);
    return report;
}

TEST(LeftOut, IsSaidWithItsReasonAndWhatIsKnownOfItsTime) {
    const std::vector<std::string> parts{"glass (nothing lets light through)"};
    const LeftOut left_out{parts, {"shadow", "defer"}};
    const std::string text = left_out_text(left_out, of_three_frames());
    EXPECT_THAT(text, HasSubstr("- glass (nothing lets light through)\n"));
    EXPECT_THAT(text, HasSubstr("shadow took 31.25 ms in one frame, and nothing in the 2 others"));
    EXPECT_THAT(text, Not(HasSubstr("defer took")));
    EXPECT_THAT(text, Not(HasSubstr("resolve"))) << "that is no pass of the scene";
    const auto json = left_out_json(left_out, of_three_frames());
    EXPECT_EQ(json["parts"][0], parts[0]);
    EXPECT_EQ(json["ran_once"].size(), 1U);
    EXPECT_EQ(json["ran_once"]["shadow"]["ms"], 31.25);
    EXPECT_EQ(json["ran_once"]["shadow"]["frames_without"], 2);
}

TEST(LeftOut, IsSilentWhereEverythingIsDone) {
    EXPECT_EQ(left_out_text({}, of_three_frames()), "");
    EXPECT_TRUE(left_out_json({}, of_three_frames())["parts"].empty());
    EXPECT_TRUE(left_out_json({}, of_three_frames())["ran_once"].empty());
    latency::SummaryReport one = of_three_frames();
    one.frames.rendered = 1;
    const std::vector<std::string> parts{"depth"};
    EXPECT_TRUE(left_out_json({parts, {"shadow"}}, one)["ran_once"].empty())
        << "there is no frame that was spared it";
}

}  // namespace
}  // namespace gazeloop::run
