#include "runtime/trade/sweep_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "runtime/trade/page/sweep_page.h"
#include "runtime/trade/point_picture.h"
#include "tests/unit/trade/made_sweep.h"

namespace gazeloop::trade {
namespace {

using testing::HasSubstr;
using testing::Not;
using tests::made_sweep;

TEST(SweepReport, WritesALinePerPointAndNoInfinityAsJson) {
    SweepRecord record = made_sweep();
    record.judged[1].figures[0].mean = std::numeric_limits<double>::infinity();
    record.judged[2] = {.of_case = 0, .point = 2, .error = "said \"no\", twice"};
    const SweepReport report = report_of(record);
    const std::string csv = sweep_csv(report);
    EXPECT_THAT(csv, HasSubstr("on_time_front,contrast\n"));
    EXPECT_THAT(
        csv,
        HasSubstr("\"scene0\",\"0,0\",kfr,\"kfr.sigma=2\",\"\",50,200,4,10,2,2,2,4,,,1,1,inf\n"));
    EXPECT_THAT(csv, HasSubstr("kfr,\"kfr.sigma=4\",\"said \"\"no\"\", twice\",,,,,,,,,,,,,\n"));
    const auto json = sweep_json(report);
    EXPECT_EQ(json.at("points")[1].at("settings").at("kfr.sigma"), "2");
    EXPECT_EQ(json.at("points")[1].at("pass_ms").at("two"), 1.5);
    EXPECT_TRUE(json.at("points")[1].at("figures").at("contrast").at("mean").is_null());
    EXPECT_EQ(json.at("points")[2].at("error"), record.judged[2].error);
    EXPECT_FALSE(json.contains("means"));
    EXPECT_THAT(sweep_text(report), HasSubstr("failed: said"));
    EXPECT_THAT(failures(report), testing::ElementsAre(HasSubstr("twice")));
}

// The plain figure of a metric with two decides the front: it must be in sight.
TEST(SweepReport, ShowsBothFiguresOfAMetricAndWhichDecidesTheFront) {
    const auto text_with = [](const std::vector<std::string>& keys) {
        SweepRecord record = made_sweep();
        for (auto& point : record.judged) {
            point.figures.clear();
            for (std::size_t i = 0; i < keys.size(); ++i) {
                point.figures.push_back({.key = keys[i],
                                         .meaning = "a figure",
                                         .lower_is_better = false,
                                         .mean = 30.0 + static_cast<double>(i)});
            }
        }
        return sweep_text(report_of(record));
    };
    const std::string psnr = text_with({"psnr_db", "psnr_weighted_db"});
    EXPECT_THAT(psnr, HasSubstr("          psnr_db psnr_weighted_db  front"));
    EXPECT_THAT(psnr, HasSubstr("          30.0000          31.0000"));
    EXPECT_THAT(psnr, HasSubstr("better by the first figure, psnr_db."));
    EXPECT_THAT(psnr, HasSubstr("\npsnr_db: higher is better"));
    const std::string all =
        text_with({"contrast", "contrast_achromatic", "contrast_flicker", "flip", "ssim",
                   "ssim_weighted", "psnr_db", "psnr_weighted_db"});
    EXPECT_THAT(all, HasSubstr("contrast contrast_flicker             flip    ssim_weighted "
                               "psnr_weighted_db  front"))
        << "there is no room for more";
    EXPECT_THAT(all, HasSubstr("better by the first figure, contrast."));
}

TEST(SweepReport, TellsEnergyWhereItIsKnown) {
    SweepRecord record = made_sweep();
    SweepReport report = report_of(record);
    EXPECT_THAT(sweep_text(report), HasSubstr("energy: unavailable"));
    EXPECT_THAT(sweep_json(report).at("points")[1].at("energy_mj").dump(), "null");
    for (TimedTurn& turn : record.turns) {
        for (PointTime& time : turn.times) {
            time.energy_j = time.point == 0 ? 0.5 : 0.125;
        }
    }
    report = report_of(record);
    EXPECT_THAT(sweep_text(report), HasSubstr("     125   4.00x"));
    EXPECT_THAT(sweep_text(report), Not(HasSubstr("unavailable")));
    EXPECT_EQ(sweep_json(report).at("points")[1].at("energy_mj"), 125.0);
    EXPECT_THAT(sweep_csv(report), HasSubstr(",4,125,4,1,1,"));
    EXPECT_THAT(sweep_page(report), HasSubstr("mJ of the processor"));
}

// Times of passes tell nothing of the wait for views before them.
TEST(SweepReport, TellsThatFramesWaitedForViews) {
    SweepRecord record = made_sweep(2);
    EXPECT_TRUE(warnings(report_of(record)).empty());
    EXPECT_THAT(sweep_text(report_of(record)), Not(HasSubstr("waited")));
    EXPECT_EQ(sweep_json(report_of(record)).at("points")[0].at("waited_frames"), 0);
    record.turns[0].times[1].waited_views = 7;  // of the first case
    record.turns[3].times[1].waited_views = 2;
    record.turns[3].times[0].waited_views = 1;
    const SweepReport report = report_of(record);
    EXPECT_THAT(warnings(report),
                testing::ElementsAre(
                    HasSubstr("scene scene0, gaze 0,0: 3 of 12 timed frames waited for 10 views")));
    EXPECT_THAT(sweep_text(report), HasSubstr("3 of 12 timed frames waited for 10 views"));
    EXPECT_THAT(sweep_page(report), HasSubstr("3 of 12 timed frames waited for 10 views"));
    const auto json = sweep_json(report);
    EXPECT_EQ(json.at("points")[1].at("timed_frames"), 4);
    EXPECT_EQ(json.at("points")[1].at("waited_frames"), 2);
    EXPECT_EQ(json.at("points")[1].at("waited_views"), 9);
    EXPECT_EQ(json.at("points")[4].at("waited_frames"), 0) << "of the other case";
    EXPECT_EQ(json.at("means")[1].at("waited_views"), 9);
    EXPECT_EQ(json.at("means")[1].at("timed_frames"), 8);
}

TEST(SweepReport, TellsWhereTheScenesContrastLies) {
    SweepRecord record = made_sweep();
    EXPECT_TRUE(sweep_json(report_of(record)).at("cases")[0].at("contrast_shares").is_null());
    record.judged[0].shares = {.kept = 0.25, .between = 0.6, .beyond = 0.15, .contrast = 0.125};
    const SweepReport report = report_of(record);
    EXPECT_THAT(sweep_text(report), HasSubstr("60.0 % lies between"));
    EXPECT_THAT(sweep_page(report), HasSubstr("60.0 % lies between"));
    EXPECT_EQ(sweep_json(report).at("cases")[0].at("contrast_shares").at("between"), 0.6);
    record.judged[0].shares = quality::ContrastShares{};
    EXPECT_THAT(sweep_text(report_of(record)), HasSubstr("no contrast"));
}

TEST(SweepReport, GivesEveryCaseTheMeanAndWhatIsRecommended) {
    SweepReport report = report_of(made_sweep(2));
    report.question = {.budget_ms = 2.0};
    report.with_fits = true;
    const auto json = sweep_json(report);
    EXPECT_EQ(json.at("cases").size(), 2U);
    EXPECT_EQ(json.at("points").size(), 6U);
    EXPECT_EQ(json.at("points")[5].at("scene"), "scene1");
    EXPECT_EQ(json.at("means").size(), 3U);
    EXPECT_EQ(json.at("recommended").at("point").at("settings").at("kfr.sigma"), "2");
    EXPECT_EQ(json.at("fits")[0].at("method"), "kfr");
    EXPECT_EQ(json.at("equal_quality").size(), 3U);
    const std::string text = sweep_text(report);
    for (const char* const part : {"scene scene1, gaze 0,0", "mean of 2 cases", "At equal quality",
                                   "Recommended for at most 2 ms: kfr kfr.sigma=2"}) {
        EXPECT_THAT(text, HasSubstr(part));
    }
    EXPECT_TRUE(failures(report).empty());
    report.question = {.floors = {{"contrast", 0.1}}};
    EXPECT_THAT(failures(report), testing::ElementsAre(HasSubstr("contrast at most 0.1")));
    EXPECT_TRUE(sweep_json(report).at("recommended").at("point").is_null());
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
        ++found;
    }
    return found;
}

TEST(SweepPage, HoldsEveryCaseAndNeedsNothingElse) {
    SweepRecord record = made_sweep(2);
    record.judged[1].picture = "AAAA";
    record.judged[1].heat_map = "BBBB";
    SweepReport report = report_of(record);
    report.question = {.budget_ms = 2.0};
    report.with_fits = true;
    const std::string page = sweep_page(report);
    EXPECT_EQ(count(page, "<figure id=\"cells-"), 3U);  // means and two cases
    EXPECT_EQ(count(page, "<figure id=\"time-"), 3U);
    EXPECT_EQ(count(page, "data:image/png;base64,AAAA"), 1U);
    EXPECT_EQ(count(page, "data:image/png;base64,BBBB"), 1U);
    EXPECT_THAT(page, HasSubstr("id=\"recommended\""));
    EXPECT_THAT(page, HasSubstr("id=\"fits\""));
    // Nothing is fetched: no address in an attribute but pictures in the file and links within it.
    EXPECT_EQ(count(page, "src=\""), count(page, "src=\"data:"));
    EXPECT_EQ(count(page, "href=\""), count(page, "href=\"#"));
    const SweepReport plain = report_of(made_sweep());
    EXPECT_THAT(sweep_page(plain), Not(HasSubstr("id=\"recommended\"")));
    EXPECT_THAT(sweep_page(plain), Not(HasSubstr("class=\"pictures\"")));
}

TEST(SweepPage, ShowsTextsAndObeysNone) {
    const std::string bad = "</script><img src=x onerror=alert(1)>\xff{{/sheets}}";
    SweepRecord record = made_sweep();
    record.cases[0].scene = bad;
    record.cases[0].gaze = bad;
    record.points[1].settings[0].second = bad;
    record.judged[2] = {.of_case = 0, .point = 2, .error = bad};
    record.subject.display = bad;
    record.judged[0].figures[0].meaning = bad;
    SweepReport report = report_of(record);
    report.command_line = bad;
    const std::string page = sweep_page(report);
    EXPECT_THAT(page, Not(HasSubstr("<img src=x")));
    EXPECT_EQ(count(page, "</script>"), 3U);
    EXPECT_THAT(page, HasSubstr("</html>"));
}

TEST(SweepPage, IsMadeOfNothingMeasured) {
    SweepRecord record = made_sweep();
    record.judged.clear();
    record.turns.clear();
    const std::string page = sweep_page(report_of(record));
    EXPECT_THAT(page, HasSubstr("not measured yet"));
    EXPECT_THAT(page, HasSubstr("</html>"));
}

TEST(PointPicture, IsThePictureMadeSmall) {
    const render::LinearPicture grey{3, 2, std::vector<glm::vec3>(6, glm::vec3(0.5F))};
    EXPECT_FALSE(small_picture(grey).empty());
    // One number per pixel of 1000 by 2, black and white in turns: squares of three are never even.
    render::LinearPicture striped{1000, 2, {}};
    for (int i = 0; i < 2000; ++i) {
        striped.pixels.emplace_back(static_cast<float>(i % 2));
    }
    EXPECT_LT(small_picture(striped).size(), 2000U);
    EXPECT_EQ(small_heat_map({}), "");
}

}  // namespace
}  // namespace gazeloop::trade
