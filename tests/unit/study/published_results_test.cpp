#include "runtime/study/published_results.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "runtime/study/published_plans.h"
#include "runtime/study/tell_published.h"
#include "tests/support/temporary_folder.h"

namespace gazeloop::study {
namespace {

using testing::HasSubstr;

SimulatedPeople people_who_see_at(const Plan& plan, double level) {
    return {
        .terms = {.noise = 0.2}, .curves = {DifferenceCurve::line(plan, level, 0.4)}, .seed = 1};
}

TEST(PublishedResults, StandBesideWhatTheMetricGives) {
    const Plan& pair = *published_plan("f3d-pair");
    const auto of_pair = against_published(pair, people_who_see_at(pair, 12.5));
    ASSERT_EQ(of_pair.size(), 1U);
    EXPECT_NEAR(of_pair[0].truth, 12.5, 1e-6);
    EXPECT_GT(of_pair[0].fitted, of_pair[0].low);
    EXPECT_NEAR(of_pair[0].fitted, 12.5, 0.5);
    EXPECT_THAT(of_pair[0].published, HasSubstr("14.9"));

    const Plan& slider = *published_plan("f3d-slider");
    const auto of_slider = against_published(slider, people_who_see_at(slider, 12.5));
    ASSERT_EQ(of_slider.size(), 8U);
    EXPECT_THAT(of_slider[1].question, HasSubstr("motion pan"));

    const Plan& kfr = *published_plan("kfr-final");
    const auto of_kfr = against_published(kfr, people_who_see_at(kfr, 1.95));
    ASSERT_EQ(of_kfr.size(), 5U);
    EXPECT_EQ(of_kfr[3].published, "1.8");
    EXPECT_EQ(of_kfr[0].published, "-");
    // 80 % of answers "same": at 1.95 less what noise takes, so at 1.8 and not at 2.
    EXPECT_THAT(of_kfr[4].question, HasSubstr("choice: sigma 1.8, alpha"));
    // Of such people none would choose anything.
    EXPECT_THAT(against_published(kfr, people_who_see_at(kfr, 0.5)).back().question,
                HasSubstr("choice: none"));
    EXPECT_TRUE(std::isnan(against_published(kfr, people_who_see_at(kfr, 0.5))[0].truth));

    const std::string text = published_text(people_who_see_at(pair, 12.5), of_pair);
    EXPECT_THAT(text, AllOf(HasSubstr("f3d-pair"), HasSubstr("jB 15"), HasSubstr("12.5")));
    const auto json = published_json(people_who_see_at(kfr, 1.95), of_kfr);
    EXPECT_TRUE(json["results"][4]["true"].is_null());
}

TEST(PublishedResults, RefuseATradeOfOtherLevels) {
    const tests::TemporaryFolder folder;
    const std::filesystem::path file = folder / "trade.json";
    std::ofstream(file) << R"({"points": []})";
    try {
        tell_published({.trades = {file.string()}});
        FAIL() << "taken";
    } catch (const SetupError& error) {
        EXPECT_EQ(error.kind(), ErrorKind::BadInput);
        EXPECT_THAT(error.what(), HasSubstr("holds all levels of no published study"));
    }
}

}  // namespace
}  // namespace gazeloop::study
