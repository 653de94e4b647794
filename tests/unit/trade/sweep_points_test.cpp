#include "runtime/trade/sweep_points.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "runtime/trade/sweep_report.h"

namespace gazeloop::trade {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> texts(const std::vector<SweepPoint>& points) {
    std::vector<std::string> list;
    for (const SweepPoint& point : points) {
        list.push_back(point.method + ": " + point.settings_text());
    }
    return list;
}

TEST(SweepPoints, AreEveryCombinationOfAMethodsOwnSettings) {
    const auto points = sweep_points(
        {"full", "kfr", "acuity"},
        {{"kfr.sigma", {"1.2", "1.8"}}, {"acuity.mar", {".022"}}, {"kfr.alpha", {"1", "4"}}});
    ASSERT_TRUE(points);
    EXPECT_THAT(texts(*points),
                ElementsAre("full: ", "kfr: kfr.sigma=1.2 kfr.alpha=1",
                            "kfr: kfr.sigma=1.2 kfr.alpha=4", "kfr: kfr.sigma=1.8 kfr.alpha=1",
                            "kfr: kfr.sigma=1.8 kfr.alpha=4", "acuity: acuity.mar=.022"));
}

TEST(SweepPoints, RefuseWhatMakesNoSweep) {
    EXPECT_FALSE(sweep_points({}, {}));
    EXPECT_FALSE(sweep_points({"kfr"}, {{"kfr.sigma", {"1"}}, {"kfr.sigma", {"2"}}}));
    const auto foreign = sweep_points({"kfr"}, {{"acuity.mar", {"1"}}});
    ASSERT_FALSE(foreign);
    EXPECT_THAT(foreign.error().message, HasSubstr("acuity.mar"));
    EXPECT_FALSE(sweep_points({"kfr"}, {{"kfrx.sigma", {"1"}}}));
    const std::vector<std::string> many(40, "1");
    EXPECT_FALSE(sweep_points({"kfr"}, {{"kfr.sigma", many}, {"kfr.alpha", many}}));
    EXPECT_TRUE(sweep_points({"kfr"}, {{"kfr.sigma", many}}));
}

TEST(Varied, IsReadFromText) {
    const auto varied = parse_varied("kfr.kernel=power,sine");
    ASSERT_TRUE(varied);
    EXPECT_EQ(varied->key, "kfr.kernel");
    EXPECT_THAT(varied->values, ElementsAre("power", "sine"));
    for (const char* const bad :
         {"", "kfr.sigma", "=1", "kfr.sigma=", "kfr.sigma=1,,2", "kfr.sigma=1,", "kfr.sigma=,1"}) {
        const auto refused = parse_varied(bad);
        ASSERT_FALSE(refused) << bad;
        EXPECT_EQ(refused.error().kind, ErrorKind::Usage);
    }
}

SweepRow row_of(const char* method, double cells) {
    SweepRow row;
    row.point = {.method = method, .settings = {{"kfr.sigma", "1.8"}}};
    row.cells = cells;
    row.speedup = 2.0;
    row.fewer_cells = 4.0;
    row.cells_over_fewest = 3.0;
    row.pass_ms = {{"disc", 1.5}};
    row.figures = {{.key = "contrast", .meaning = "thresholds", .mean = 0.5},
                   {.key = "psnr_db",
                    .meaning = "dB",
                    .lower_is_better = false,
                    .mean = std::numeric_limits<double>::infinity()}};
    return row;
}

TEST(SweepReport, WritesALinePerPointAndNoInfinityAsJson) {
    SweepRow failed;
    failed.point.method = "kfr";
    failed.error = "said \"no\", twice";
    const std::vector<SweepRow> rows{row_of("kfr", 100.0), failed};
    const std::string csv = sweep_csv(rows);
    EXPECT_THAT(csv, HasSubstr("on_time_front,contrast,psnr_db\n"));
    EXPECT_THAT(csv, HasSubstr("kfr,\"kfr.sigma=1.8\",\"\",100,4,3,0,0,0,2,0,0,0.5,inf\n"));
    EXPECT_THAT(csv, HasSubstr("kfr,\"\",\"said \"\"no\"\", twice\",,,,,,,,,,,\n"));
    SweepQuestion question;
    question.gaze.resize(1);
    const auto json = sweep_json({}, question, rows);
    EXPECT_EQ(json.at("points")[0].at("settings").at("kfr.sigma"), "1.8");
    EXPECT_EQ(json.at("points")[0].at("pass_ms").at("disc"), 1.5);
    EXPECT_TRUE(json.at("points")[0].at("figures").at("psnr_db").at("mean").is_null());
    EXPECT_EQ(json.at("points")[1].at("error"), failed.error);
    EXPECT_THAT(sweep_text({}, question, rows), HasSubstr("failed: said"));
}

}  // namespace
}  // namespace gazeloop::trade
