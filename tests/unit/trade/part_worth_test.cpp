#include "runtime/trade/part_worth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "runtime/methods/registry.h"
#include "runtime/render/render_settings.h"
#include "runtime/trade/page/sweep_page.h"
#include "runtime/trade/sweep_report.h"
#include "runtime/trade/worth_points.h"
#include "tests/unit/trade/made_sweep.h"

namespace gazeloop::trade {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using tests::made_sweep;

/// kfr as it is (2 ms a frame), without what no picture needs (1 ms), and with what makes it worse
/// and faster (.5 ms).
SweepRecord worth_sweep() {
    SweepRecord record = made_sweep(1, 2, 3);
    record.points = {{.method = "full"},
                     {.method = "kfr"},
                     {.method = "kfr", .settings = {{"render.lp_gaussian", "off"}}},
                     {.method = "kfr", .settings = {{"kfr.disc", "false"}}}};
    JudgedPoint same = record.judged[1];
    same.point = 2;
    JudgedPoint worse = record.judged[2];
    worse.point = 3;
    record.judged[2] = same;
    record.judged.push_back(worse);
    for (TimedTurn& turn : record.turns) {
        turn.times[2].pass_ms = {0.25, 0.75};
        turn.times.push_back({.point = 3, .pass_ms = {0.25, 0.25}});
    }
    return record;
}

std::optional<MethodWorth> worth_in(const SweepRecord& record) {
    return method_worth(record.subject, sheets_of(record).front().rows);
}
MethodWorth worth_of(const SweepRecord& record) { return worth_in(record).value(); }

TEST(PartWorth, HoldsEachChangeAgainstTheMethodAsItIs) {
    const MethodWorth worth = worth_of(worth_sweep());
    EXPECT_EQ(worth.method, "kfr");
    EXPECT_EQ(worth.figure, "contrast");
    ASSERT_EQ(worth.parts.size(), 2U);
    const PartWorth& needless = worth.parts[0];
    EXPECT_EQ(needless.change, "render.lp_gaussian=off");
    EXPECT_DOUBLE_EQ(needless.time, 0.5);
    EXPECT_DOUBLE_EQ(needless.cells, 1.0);
    EXPECT_TRUE(needless.same && needless.is_needless());
    EXPECT_EQ(needless.verdict(), "changes no picture, and saves 50 % of the time");
    const PartWorth& trade = worth.parts[1];
    EXPECT_DOUBLE_EQ(trade.time, 0.25);
    EXPECT_DOUBLE_EQ(trade.cells, 0.25);
    EXPECT_DOUBLE_EQ(trade.loss, 2.0);
    EXPECT_FALSE(trade.is_needless());
    EXPECT_EQ(trade.verdict(), "a trade: worse, and saves 75 % of the time");
}

TEST(PartWorth, SaysNothingOfTimesThatOverlapAndSeesTheLastBit) {
    SweepRecord record = worth_sweep();
    record.turns[0].times[2].pass_ms = {1.5, 1.5};  // of the first of three rounds
    record.turns[1].times[2].pass_ms = {1.5, 1.5};
    EXPECT_EQ(worth_of(record).parts[0].verdict(), "changes no picture");
    record = worth_sweep();
    double& mean = record.judged[2].figures[0].mean;
    mean = std::nextafter(mean, 0.0);
    EXPECT_EQ(worth_of(record).parts[0].verdict(), "better, and saves 50 % of the time");
    mean = std::nextafter(2.0, 3.0);
    EXPECT_GT(worth_of(record).parts[0].loss, 0.0);
    // Of a figure that is better the higher, also where it is infinite.
    for (JudgedPoint& judged : record.judged) {
        judged.figures[0].lower_is_better = false;
        judged.figures[0].mean = std::numeric_limits<double>::infinity();
    }
    record.judged[3].figures[0].mean = 40.0;
    EXPECT_EQ(worth_of(record).parts[0].loss, 0.0);
    EXPECT_GT(worth_of(record).parts[1].loss, 0.0);
}

TEST(PartWorth, CallsNeedlessOnlyWhatIsSwitchedOffAndWhatRoundsShow) {
    SweepRecord record = worth_sweep();
    EXPECT_TRUE(worth_of(record).parts[0].is_needless());
    record.subject.rounds = 2;  // too few to tell
    EXPECT_FALSE(worth_of(record).parts[0].time_is_clear);
    record.subject.rounds = 3;
    for (const char* const on : {"on", "scene", "8"}) {
        record.points[2].settings.front().second = on;
        EXPECT_EQ(worth_of(record).parts[0].is_needless(), std::string_view(on) == "8") << on;
    }
    record.points[2].settings = {{"interleaved.every", "8"}};
    EXPECT_FALSE(worth_of(record).parts[0].is_needless());
    record.points[2].settings = {{"kfr.disc", "false"}};
    EXPECT_TRUE(worth_of(record).parts[0].is_needless());
    for (TimedTurn& turn : record.turns) {
        turn.times[2].pass_ms = {0.5, 1.45};  // of 2: within 3 %
    }
    EXPECT_EQ(worth_of(record).parts[0].verdict(), "changes no picture");
    record.subject.frames = 1;
    record.turns.resize(3);
    for (unsigned round = 0; round < 3; ++round) {
        record.turns[round].round = round;
        record.turns[round].frame = 0;
    }
    EXPECT_THAT(worth_text(worth_of(record)), HasSubstr("One frame shows nothing of what needs"));
}

TEST(PartWorth, IsOfSuchSweepsAlone) {
    EXPECT_FALSE(method_worth({}, {}));
    EXPECT_FALSE(worth_in(made_sweep()));  // none as it is
    SweepRecord record = worth_sweep();
    record.points[3].settings.emplace_back("kfr.sigma", "3");
    EXPECT_FALSE(worth_in(record));
    record = worth_sweep();
    record.points[3].method = "acuity";
    EXPECT_FALSE(worth_in(record));
    record = worth_sweep();
    record.judged[1] = {.of_case = 0, .point = 1, .error = "no"};
    EXPECT_FALSE(worth_in(record));
    // A part that fails says so, beside the others.
    record = worth_sweep();
    record.judged[3] = {.of_case = 0, .point = 3, .error = "no hole allowed"};
    EXPECT_EQ(worth_of(record).parts[1].verdict(), "no hole allowed");
}

TEST(PartWorth, IsInEveryReport) {
    const SweepReport report = report_of(worth_sweep());
    const std::string text = sweep_text(report);
    EXPECT_THAT(text, HasSubstr("What each part of kfr costs and is worth"));
    EXPECT_THAT(text, HasSubstr("leave it off: --set render.lp_gaussian=off\n"));
    EXPECT_THAT(sweep_text(report_of(made_sweep())), Not(HasSubstr("costs and is worth")));
    const auto json = sweep_json(report);
    EXPECT_EQ(json.at("worth").at("parts")[0].at("needless"), true);
    EXPECT_EQ(json.at("worth").at("parts")[1].at("loss"), 2.0);
    EXPECT_THAT(sweep_page(report), HasSubstr("id=\"worth\""));
    EXPECT_THAT(sweep_page(report_of(made_sweep())), Not(HasSubstr("id=\"worth\"")));
}

/// Those of methods and rendering.
struct Settings {
    Settings() {
        settings.add(methods::rows_of(of_methods));
        settings.add(render::rows_of(of_render, methods::rendered_methods()));
    }

    methods::MethodSettings of_methods;
    render::RenderSettings of_render;
    settings::Settings settings;
};

std::vector<std::string> changes(const std::string& method,
                                 const std::vector<std::pair<std::string, std::string>>& set) {
    Settings in_force;
    for (const auto& [key, value] : set) {
        value_or_throw(in_force.settings.set(key, value, "test"));
    }
    std::vector<std::string> texts;
    for (const SweepPoint& point : value_or_throw(worth_points(method, in_force.settings))) {
        EXPECT_EQ(point.method, method);
        texts.push_back(point.settings_text());
    }
    return texts;
}

TEST(WorthPoints, ChangeWhatCanBeSwitchedOneAtATime) {
    const auto kfr = changes("kfr", {});
    EXPECT_EQ(kfr.front(), "");
    for (const char* const change : {"kfr.disc=false", "render.require=all", "render.taa=true",
                                     "render.lp_gaussian=off", "render.lp_gaussian=on"}) {
        EXPECT_THAT(kfr, Contains(change));
    }
    for (const char* const no : {"acuity.disc=false", "render.lp_gaussian=scene", "kfr.disc=true",
                                 "render.post_filter=0", "render.taa_reset=false"}) {
        EXPECT_THAT(kfr, Not(Contains(no)));
    }
    const auto filtered = changes("kfr", {{"render.taa", "true"}, {"render.post_filter", "3"}});
    for (const char* const change :
         {"render.taa=false", "render.taa_reset=false", "render.post_filter=0"}) {
        EXPECT_THAT(filtered, Contains(change));
    }
    EXPECT_THAT(changes("full", {}), Not(Contains("")));
    EXPECT_THAT(changes("interleaved", {}), Contains("interleaved.refill=false"));
}

TEST(WorthPoints, RefuseAMethodThatThereIsNot) {
    const Settings in_force;
    const auto points = worth_points("kfrr", in_force.settings);
    ASSERT_FALSE(points);
    EXPECT_EQ(points.error().kind, ErrorKind::Usage);
    EXPECT_THAT(points.error().message, HasSubstr("kfr"));
}

}  // namespace
}  // namespace gazeloop::trade
