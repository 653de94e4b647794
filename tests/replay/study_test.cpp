// The program as its users run it: a study from its plan to its analysis, and a trial shown again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

using testing::HasSubstr;

/// Four cells, with pictures that last some frames.
constexpr const char* kPlan = R"(format = "gazeloop-study"
version = 1
name = "quick"
design = "2afc"
method = "kfr"
sessions = 1
validation = 0.34
shown_s = 0.1
black_s = 0.02
answer_s = 0.02
rest_s = 0.1

[[factor]]
name = "sigma"
key = "kfr.sigma"
levels = [1.2, 3.2]

[[factor]]
name = "alpha"
key = "kfr.alpha"
levels = [1, 4]
)";

class StudyProgram : public testing::Test {
  protected:
    ProgramResult sit(const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"study",
                                           "run",
                                           plan_,
                                           "--folder",
                                           folder_.file("answers"),
                                           "--gaze",
                                           "fixed:0,0",
                                           "--target",
                                           "headless",
                                           "--clock",
                                           "virtual",
                                           "--set",
                                           "render.scale=0.02",
                                           "--simulated",
                                           "--hash",
                                           "--threshold",
                                           "1.8"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_gazeloop(arguments);
    }
    std::string session(unsigned subject, unsigned sitting) {
        return folder_.file("answers/quick.00" + std::to_string(subject) + ".00" +
                            std::to_string(sitting) + ".gaze");
    }

    ScratchFolder folder_;
    std::string plan_ = folder_.write("plan.toml", kPlan);
};

TEST_F(StudyProgram, GoesOnAfterAnInterruptionAndShowsEveryTrialAgain) {
    const ProgramResult first = sit({"--subject", "1", "--frames", "45"});
    ASSERT_EQ(first.exit_code, 0) << first.err << first.out;
    EXPECT_THAT(first.err, HasSubstr("6 trials left"));
    const ProgramResult second = sit({"--subject", "1"});
    ASSERT_EQ(second.exit_code, 0) << second.err << second.out;
    EXPECT_THAT(second.err, HasSubstr(" 0 trials left"));
    EXPECT_THAT(sit({"--subject", "1"}).out, HasSubstr("subject 1 has answered all of quick"));
    ASSERT_EQ(sit({"--subject", "2"}).exit_code, 0);

    struct stat status{};
    ASSERT_EQ(stat(session(1, 1).c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, 0600U);
    for (const std::string& file : {session(1, 1), session(1, 2), session(2, 1)}) {
        const ProgramResult again = run_gazeloop({"replay", file, "--hash"});
        EXPECT_EQ(again.exit_code, 0) << again.err << again.out;
        EXPECT_THAT(again.out, HasSubstr("pixel")) << again.out;
    }

    const std::string json = folder_.file("result.json");
    const ProgramResult analysed = run_gazeloop(
        {"study", "analyse", plan_, session(1, 1), session(1, 2), session(2, 1), "--json", json,
         "--html", folder_.file("page.html"), "--r-csv", folder_.file("r.csv")});
    ASSERT_EQ(analysed.exit_code, 0) << analysed.err;
    std::ifstream in(json);
    const nlohmann::json result = nlohmann::json::parse(in);
    for (const nlohmann::json& subject : result["subjects"]) {
        EXPECT_EQ(subject["answers"], 4);
        EXPECT_EQ(subject["validations"], 2);
    }
    EXPECT_EQ(result["cells"].size(), 4U);

    EXPECT_EQ(run_gazeloop({"study", "analyse", plan_, session(2, 1), session(2, 1)}).exit_code, 3);
    const ProgramResult gone =
        run_gazeloop({"study", "forget", "1", session(1, 1), session(1, 2), session(2, 1)});
    EXPECT_THAT(gone.out, HasSubstr("the session of subject 1 removed"));
    EXPECT_FALSE(std::filesystem::exists(session(1, 2)));
    EXPECT_TRUE(std::filesystem::exists(session(2, 1)));
}

TEST_F(StudyProgram, RefusesWhatItCannotShow) {
    const auto refused = [&](std::string_view from, std::string_view to) {
        std::string text = kPlan;
        text.replace(text.find(from), from.size(), to);
        plan_ = folder_.write("other.toml", text);
        const ProgramResult result = sit({"--subject", "1"});
        EXPECT_NE(result.exit_code, 0);
        return result.err;
    };
    EXPECT_THAT(refused("kfr.alpha", "layers.n"),
                AllOf(HasSubstr("the method kfr has no such setting"), HasSubstr("layers.n")));
    EXPECT_THAT(refused("kfr.alpha", "kfr.alhpa"), HasSubstr("did you mean 'kfr.alpha'"));
    EXPECT_THAT(refused("3.2]", "1e9]"), HasSubstr("kfr.sigma"));
    EXPECT_THAT(refused("\"kfr\"\nsess", "\"krf\"\nsess"), HasSubstr("krf"));
    EXPECT_THAT(refused("2afc", "3afc"), HasSubstr("unknown design"));
    EXPECT_FALSE(std::filesystem::exists(folder_.file("answers")));
}

TEST_F(StudyProgram, PlansSimulatesAndSaysHowMuchItFinds) {
    const std::string plan = folder_.file("pair.toml");
    ASSERT_EQ(run_gazeloop({"study", "plan", "f3d-pair", plan}).exit_code, 0);
    const ProgramResult unknown = run_gazeloop({"study", "plan", "f3d-pear"});
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_THAT(unknown.err, HasSubstr("did you mean 'f3d-pair'"));
    const std::string answers = folder_.file("answers.csv");
    ASSERT_EQ(run_gazeloop({"study", "simulate", plan, answers, "--threshold", "12"}).exit_code, 0);
    struct stat status{};
    ASSERT_EQ(stat(answers.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, 0600U);
    const ProgramResult result = run_gazeloop({"study", "analyse", plan, answers});
    EXPECT_THAT(result.out, HasSubstr("15 subjects, 450 answers"));
    const ProgramResult power = run_gazeloop({"study", "power", plan, "--studies", "3", "--json"});
    ASSERT_EQ(power.exit_code, 0) << power.err;
    const nlohmann::json json = nlohmann::json::parse(power.out);
    EXPECT_EQ(json["plans"][0]["rows"].size(), 4U);
    EXPECT_EQ(json["plans"][0]["rows"][2]["subjects"], 15);
}

}  // namespace
}  // namespace gazeloop::tests
