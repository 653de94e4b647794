#include "runtime/study/analysis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "runtime/files/output_file.h"
#include "runtime/study/analysis_page.h"
#include "runtime/study/analysis_report.h"
#include "runtime/study/published_plans.h"
#include "runtime/study/responses_file.h"
#include "runtime/study/study_files.h"
#include "tests/support/temporary_folder.h"

namespace gazeloop::study {
namespace {

using testing::DoubleNear;
using testing::HasSubstr;

Response response(unsigned subject, unsigned number, std::vector<double> levels, Answer answer,
                  bool reference_first = true) {
    return {.subject = subject,
            .trial = {.number = number,
                      .kind = levels.empty() ? TrialKind::Validation : TrialKind::Test,
                      .levels = std::move(levels),
                      .reference_first = reference_first},
            .answer = answer};
}

TEST(SubjectThresholds, FollowThePapersRules) {
    const Plan& pair = *published_plan("f3d-pair");
    // The first subject calls 10 better when it comes first, 9 never; the second 14 the same.
    std::vector<Response> answers{response(1, 0, {9.0}, Answer::FirstBetter),
                                  response(1, 1, {9.0}, Answer::SecondBetter, false),
                                  response(1, 2, {10.0}, Answer::FirstBetter),
                                  response(1, 3, {10.0}, Answer::FirstBetter, false),
                                  response(1, 4, {12.0}, Answer::FirstBetter),
                                  response(2, 0, {14.0}, Answer::Same),
                                  response(2, 1, {13.0}, Answer::FirstBetter),
                                  response(2, 2, {22.0}, Answer::SecondBetter)};
    const StudyResult of_pair = analyse(pair, answers);
    EXPECT_EQ(of_pair.subjects[0].thresholds[0], 10.0);
    EXPECT_EQ(of_pair.subjects[1].thresholds[0], 14.0);
    EXPECT_NEAR(of_pair.thresholds[0].mean, 12.0, 1e-12);
    EXPECT_NEAR(of_pair.thresholds[0].deviation, std::sqrt(8.0), 1e-12);

    // Ramps: labelled the wrong way at 7, no change seen at 10, right at 5.
    const Plan& ramp = *published_plan("f3d-ramp");
    answers = {response(1, 0, {5.0}, Answer::Down), response(1, 1, {5.0}, Answer::Up, false),
               response(1, 2, {7.0}, Answer::Up), response(1, 3, {10.0}, Answer::Same)};
    EXPECT_EQ(analyse(ramp, answers).subjects[0].thresholds[0], 7.0);
    answers.resize(2);
    EXPECT_EQ(analyse(ramp, answers).subjects[0].thresholds[0], std::nullopt);

    // Sliders: the mean of first stops, by motion.
    const Plan& slider = *published_plan("f3d-slider");
    answers = {response(1, 0, {9.0, 2.0}, Answer::Equal),
               response(1, 1, {12.0, 2.0}, Answer::Equal),
               response(1, 2, {22.0, 3.0}, Answer::Unable)};
    const StudyResult of_slider = analyse(slider, answers);
    EXPECT_EQ(of_slider.subjects[0].thresholds[1], 10.5);
    EXPECT_EQ(of_slider.subjects[0].thresholds[2], std::nullopt);
    // What was passed counts as not equal: 4 to 8 twice, 9 once each way.
    EXPECT_EQ(of_slider.cells[0 * 8 + 1].yes.trials, 2U);
    EXPECT_EQ(of_slider.cells[5 * 8 + 1].yes.trials, 2U);
    EXPECT_EQ(of_slider.cells[5 * 8 + 1].yes.yes, 1U);
    EXPECT_EQ(of_slider.cells[18 * 8 + 2].yes.yes, 0U);
}

TEST(Analysis, CountsCellsOverSubjects) {
    Plan plan = *published_plan("kfr-final");
    std::vector<Response> answers;
    // Subject 1 says same 3 of 3 times, subject 2 1 of 3; a spoilt answer and training count not.
    for (unsigned i = 0; i < 3; ++i) {
        answers.push_back(response(1, i, {1.8, 4.0}, Answer::Same));
        answers.push_back(response(2, i, {1.8, 4.0}, i == 0 ? Answer::Same : Answer::Different));
    }
    answers.push_back(response(1, 3, {1.8, 4.0}, Answer::Different));
    answers.back().fault = TrialFault::GazeLost;
    answers.push_back(response(1, 4, {1.8, 4.0}, Answer::Different));
    answers.back().trial.kind = TrialKind::Training;
    const StudyResult result = analyse(plan, answers);
    const CellResult& cell = result.cells[3 * 4 + 3];
    EXPECT_EQ(cell.levels, (std::vector<double>{1.8, 4.0}));
    EXPECT_EQ(cell.yes.yes, 4U);
    EXPECT_EQ(cell.yes.trials, 6U);
    EXPECT_NEAR(cell.subjects_mean, 2.0 / 3.0, 1e-12);
    EXPECT_NEAR(cell.standard_error, 1.0 / 3.0, 1e-12);
    EXPECT_EQ(result.subjects[0].spoilt, 1U);
    EXPECT_TRUE(std::isnan(result.cells[0].yes.share));
    EXPECT_TRUE(std::isnan(result.thresholds[0].fitted));  // alpha 1: nothing was answered
    EXPECT_FALSE(analysis_json(result).dump().find("nan") != std::string::npos);
}

TEST(Analysis, LeavesOutWhoFailsTooManyValidations) {
    const Plan& plan = *published_plan("kfr-final");
    std::vector<Response> answers;
    for (const unsigned subject : {1U, 2U}) {
        for (unsigned i = 0; i < 4; ++i) {
            const bool fails = i < subject;  // 1 of 4 is a quarter, and not more
            answers.push_back(response(subject, i, {}, fails ? Answer::Different : Answer::Same));
            answers.push_back(response(subject, 4 + i, {2.4, 1.0}, Answer::Same));
        }
    }
    const StudyResult result = analyse(plan, answers);
    EXPECT_FALSE(result.subjects[0].excluded);
    EXPECT_TRUE(result.subjects[1].excluded);
    EXPECT_EQ(result.subjects[1].failed, 2U);
    EXPECT_EQ(result.cells[std::size_t{6} * 4].yes.trials, 4U);
    EXPECT_THAT(analysis_text(result),
                HasSubstr("left out: subject 2, 2 of 4 validation trials failed"));
    EXPECT_THAT(decisions_csv(result, answers), Not(HasSubstr("\n2,")));
}

TEST(Analysis, TestsConditionsAgainstEachOther) {
    Plan plan = *published_plan("kfr-final");
    std::vector<Response> answers;
    // Of 12 subjects all see no difference at alpha 4, and 2 at alpha 1; one lacks an answer.
    for (unsigned subject = 1; subject <= 12; ++subject) {
        for (unsigned alpha = 1; alpha <= 4; ++alpha) {
            if (subject == 12 && alpha == 2) {
                continue;
            }
            const bool same = alpha == 4 || (subject <= 2);
            answers.push_back(response(subject, alpha, {1.8, static_cast<double>(alpha)},
                                       same ? Answer::Same : Answer::Different));
        }
    }
    const LevelTest test = analyse(plan, answers).tests[3];
    EXPECT_EQ(test.level, 1.8);
    EXPECT_EQ(test.blocks, 11U);
    ASSERT_TRUE(test.q);
    // By hand: k = 4, C = 2, 2, 2, 11, T = 17, R = 4, 4 and nine times 1.
    EXPECT_NEAR(test.q->q, 3.0 * (4.0 * (3 * 4 + 121) - 289) / (4.0 * 17 - (32 + 9)), 1e-12);
    const LevelTest::PairTest& last = test.pairs[2];  // alpha 1 and 4
    EXPECT_EQ(last.second_alone, 9U);
    EXPECT_EQ(last.first_alone, 0U);
    EXPECT_NEAR(last.p, 2.0 / 512.0, 1e-12);
    EXPECT_NEAR(last.holm_p, 6.0 * last.p, 1e-12);
    EXPECT_EQ(test.pairs[0].holm_p, 1.0);
}

TEST(ResponsesFile, ReadsBackWhatItWroteAndRefusesTheRest) {
    const Plan& plan = *published_plan("f3d-slider");
    std::vector<Response> answers{response(3, 7, {9.0, 2.0}, Answer::Equal)};
    answers[0].after_s = 0.1 + 0.2;
    answers[0].settled = 11.0;
    answers[0].fault = TrialFault::GazeOff;
    const std::string csv = responses_csv(plan, answers);
    const auto again = responses_of(plan, csv, "a.csv");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(responses_csv(plan, *again), csv);
    EXPECT_EQ(again->at(0).after_s, 0.1 + 0.2);
    const auto message = [&](std::string_view from, std::string_view to) {
        std::string text = csv;
        text.replace(text.rfind(from), from.size(), to);
        const auto read = responses_of(plan, text, "a.csv");
        return read ? std::string("accepted") : read.error().message;
    };
    EXPECT_THAT(message("equal", "same"), HasSubstr("a.csv:2: the design slider has no answer"));
    EXPECT_THAT(message("equal", "eqal"), HasSubstr("'eqal' is no answer"));
    EXPECT_THAT(message("9,", "9.5,"), HasSubstr("9.5 is no level of j"));
    EXPECT_THAT(message("9,", "nan,"), HasSubstr("no level of j"));
    EXPECT_THAT(message("9,", ","), HasSubstr("1 levels where"));
    EXPECT_THAT(message("3,7", "0,7"), HasSubstr("numbered from 1"));
    EXPECT_THAT(message("3,7", "-3,7"), HasSubstr("is no subject's number"));
    EXPECT_THAT(message(",gaze-off", ""), HasSubstr("11 cells where 12"));
    EXPECT_THAT(message("motion", "speed"), HasSubstr("a.csv:1: these are not answers"));
    EXPECT_FALSE(responses_of(plan, "", "a.csv"));
    const tests::TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "a.csv";
    ASSERT_TRUE(files::write_text(file, csv, files::kOwnerOnly));
    EXPECT_EQ(std::filesystem::status(file).permissions(),
              std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    const std::vector<std::filesystem::path> twice{file, file};
    EXPECT_THAT(gather(plan, twice).error().message, HasSubstr("subject 3's answer to trial 7"));
}

// What study analyse --r-csv wrote has lines of persons, too.
TEST(Forget, RemovesLinesForR) {
    const Plan& plan = *published_plan("f3d-pair");
    const tests::TemporaryFolder folder;
    const std::filesystem::path file = folder / "r.csv";
    const std::vector<Response> answers{response(1, 0, {9.0}, Answer::Same),
                                        response(11, 0, {9.0}, Answer::Same)};
    ASSERT_TRUE(
        files::write_text(file, decisions_csv(analyse(plan, answers), answers), files::kOwnerOnly));
    const std::vector<std::filesystem::path> files{file};
    const auto said = forget(1, files);
    ASSERT_TRUE(said) << said.error().message;
    EXPECT_THAT(said->at(0), HasSubstr("1 answers of subject 1 removed"));
    std::ifstream in(file);
    const std::string left(std::istreambuf_iterator<char>(in), {});
    EXPECT_THAT(left, HasSubstr("# lme4"));
    EXPECT_THAT(left, HasSubstr("\n11,"));
}

TEST(Forget, RemovesOneSubjectAndSaysWhat) {
    const Plan& plan = *published_plan("f3d-pair");
    const tests::TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "a.csv";
    const std::vector<Response> answers{response(1, 0, {9.0}, Answer::Same),
                                        response(11, 0, {9.0}, Answer::Same),
                                        response(1, 1, {9.0}, Answer::Same)};
    ASSERT_TRUE(files::write_text(file, responses_csv(plan, answers), files::kOwnerOnly));
    const std::vector<std::filesystem::path> files{file};
    const auto said = forget(1, files);
    ASSERT_TRUE(said);
    EXPECT_THAT(said->at(0), HasSubstr("2 answers of subject 1 removed"));
    const auto left = gather(plan, files);
    ASSERT_TRUE(left);
    ASSERT_EQ(left->size(), 1U);
    EXPECT_EQ(left->at(0).subject, 11U);
    EXPECT_EQ(forget(1, files)->at(0), "");
    const std::vector<std::filesystem::path> missing{folder.path() / "b.csv"};
    EXPECT_FALSE(forget(1, missing));
}

TEST(AnalysisPage, ShowsTextAsText) {
    Plan plan = *published_plan("kfr-final");
    plan.source = "<script>alert(1)</script> & \"more\"";
    const std::string page =
        analysis_page(analyse(plan, std::vector{response(1, 0, {1.8, 4.0}, Answer::Same)}));
    EXPECT_THAT(page, HasSubstr("&lt;script&gt;alert(1)&lt;/script&gt; &amp; &quot;more&quot;"));
    EXPECT_THAT(page, Not(HasSubstr("<script")));
    EXPECT_THAT(page, Not(HasSubstr("nan")));
    // Without any answer there is a page too.
    EXPECT_THAT(analysis_page(analyse(plan, {})), Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace gazeloop::study
