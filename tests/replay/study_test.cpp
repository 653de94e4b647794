// The program as its users run it: a study from its plan to its analysis, and a trial shown again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/run_program.h"
#include "tests/unit/session/child_process.h"

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
    ProgramResult sit(const std::vector<std::string>& more) { return run_gazeloop(sitting(more)); }
    std::vector<std::string> sitting(const std::vector<std::string>& more) {
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
        return arguments;
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

TEST_F(StudyProgram, IsKilledAndHasEveryAnswerThatItTold) {
    for (const int told : {0, 2, 4}) {
        const unsigned subject = static_cast<unsigned>(told) + 1;
        const std::string name = std::to_string(subject);
        const ProgramResult killed = run_gazeloop(
            sitting({"--subject", name}),
            {.trigger = "trial " + std::to_string(told) + ":", .on_trigger = [&](int pid) {
                 const ProgramResult second = sit({"--subject", name});
                 EXPECT_EQ(second.exit_code, 3);
                 EXPECT_THAT(second.err, HasSubstr("another program asks this subject"));
                 kill(pid, SIGKILL);
             }});
        EXPECT_EQ(killed.exit_code, 128 + SIGKILL) << killed.err;
        const ProgramResult rest = sit({"--subject", name});
        ASSERT_EQ(rest.exit_code, 0) << rest.err;
        EXPECT_THAT(rest.err, HasSubstr(" 0 trials left"));
        // Neither lost nor repeated: a trial in two files would be an error.
        const ProgramResult analysed = run_gazeloop(
            {"study", "analyse", plan_, session(subject, 1), session(subject, 2), "--json"});
        ASSERT_EQ(analysed.exit_code, 0) << analysed.err;
        const nlohmann::json of = nlohmann::json::parse(analysed.out)["subjects"][0];
        EXPECT_EQ(of["answers"], 4);
        EXPECT_EQ(of["validations"], 2);
        EXPECT_EQ(rest.err.find("trial " + std::to_string(told) + ":"), std::string::npos)
            << "told, and asked again: " << rest.err;
    }
}

// As a disk that is full: files cannot grow.
TEST_F(StudyProgram, EndsAtADiskThatIsFullAndAsksTheLostAnswerAgain) {
    const int result = session::run_in_child([this] {
        const rlimit limit{150'000, 150'000};
        if (setrlimit(RLIMIT_FSIZE, &limit) != 0) {
            return 2;
        }
        const ProgramResult full = sit({"--subject", "1"});
        EXPECT_EQ(full.exit_code, 6) << full.err;
        EXPECT_THAT(full.err, HasSubstr("recording ended early"));
        EXPECT_THAT(full.err, HasSubstr("the study ends"));
        EXPECT_THAT(full.err, Not(HasSubstr(" 0 trials left")));
        return HasFailure() ? 1 : 0;
    });
    ASSERT_EQ(result, 0);
    const ProgramResult rest = sit({"--subject", "1"});
    ASSERT_EQ(rest.exit_code, 0) << rest.err;
    const ProgramResult analysed =
        run_gazeloop({"study", "analyse", plan_, session(1, 1), session(1, 2), "--json"});
    ASSERT_EQ(analysed.exit_code, 0) << analysed.err;
    EXPECT_EQ(nlohmann::json::parse(analysed.out)["subjects"][0]["answers"], 4);
}

TEST_F(StudyProgram, ShowsScenesByTurnsAndCarriesTheViewer) {
    std::string text = kPlan;
    text.replace(text.find("sessions = 1"), 12,
                 "sessions = 2\nscenes = [\"raymarch\", \"gallery\"]");
    text.replace(text.find("kfr.alpha\"\nlevels = [1, 4]"), 27,
                 "render.camera\"\nlevels = [1, 2]\nvalues = [\"still\", \"fly-6\"]");
    plan_ = folder_.write("scenes.toml", text);
    for (const unsigned subject : {1U, 2U}) {
        const ProgramResult sat = sit({"--subject", std::to_string(subject)});
        ASSERT_EQ(sat.exit_code, 0) << sat.err << sat.out;
        EXPECT_THAT(sat.err, HasSubstr(" 0 trials left"));
        const ProgramResult again = run_gazeloop({"replay", session(subject, 1), "--hash"});
        EXPECT_EQ(again.exit_code, 0) << again.err << again.out;
        EXPECT_THAT(again.out, HasSubstr("pixel")) << again.out;
    }
    const ProgramResult analysed =
        run_gazeloop({"study", "analyse", plan_, session(1, 1), session(2, 1), "--json"});
    ASSERT_EQ(analysed.exit_code, 0) << analysed.err;
    const nlohmann::json result = nlohmann::json::parse(analysed.out);
    EXPECT_EQ(result["cells"].size(), 8U);
    for (const nlohmann::json& cell : result["cells"]) {
        EXPECT_EQ(cell["trials"], 1);  // each subject's first session has one of the scenes
    }
    EXPECT_EQ(result["thresholds"].size(), 4U);
    // One session has one scene.
    text.replace(text.find("sessions = 2"), 12, "sessions = 1");
    plan_ = folder_.write("scenes.toml", text);
    const ProgramResult few = sit({"--subject", "3"});
    EXPECT_EQ(few.exit_code, 3);
    EXPECT_THAT(few.err, HasSubstr("sessions is 1, and 2 are needed"));
}

TEST_F(StudyProgram, HasPeopleWhoSeeByTheMetricOfATrade) {
    const std::string trade = folder_.file("trade.json");
    const ProgramResult traded = run_gazeloop({"trade",
                                               "--methods",
                                               "kfr",
                                               "--sigma",
                                               "1.2,3.2",
                                               "--alpha",
                                               "1,4",
                                               "--metric",
                                               "contrast",
                                               "--frames",
                                               "1",
                                               "--rounds",
                                               "1",
                                               "--reference-spp",
                                               "1",
                                               "--set",
                                               "render.scale=0.05",
                                               "--quiet",
                                               "--json",
                                               trade});
    ASSERT_EQ(traded.exit_code, 0) << traded.err;
    const std::string answers = folder_.file("answers.csv");
    const ProgramResult simulated =
        run_gazeloop({"study", "simulate", plan_, answers, "--subjects", "3", "--trade", trade});
    ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
    EXPECT_THAT(run_gazeloop({"study", "analyse", plan_, answers}).out,
                HasSubstr("3 subjects, 12 answers"));
    // Of the layers acuity.mar is varied, which is of another group.
    const std::string layers = folder_.file("layers.json");
    const ProgramResult of_layers =
        run_gazeloop({"trade", "--methods", "layers", "--mar", "0.022,0.0275", "--metric",
                      "contrast", "--frames", "1", "--rounds", "1", "--reference-spp", "1", "--set",
                      "render.scale=0.05", "--quiet", "--json", layers});
    ASSERT_EQ(of_layers.exit_code, 0) << of_layers.err;
    const ProgramResult published = run_gazeloop({"study", "published", layers});
    EXPECT_EQ(published.exit_code, 3) << published.out;
    EXPECT_THAT(published.err, HasSubstr("holds all levels of no published study"));
}

TEST_F(StudyProgram, SaysThatNobodyAnswersWhereNobodyCan) {
    std::vector<std::string> words = sitting({"--subject", "1"});
    std::erase(words, "--simulated");
    const ProgramResult result = run_gazeloop(words);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_THAT(result.err, AllOf(HasSubstr("nobody can answer"), HasSubstr("--preview")));
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
    EXPECT_THAT(refused("kfr.alpha", "sparse.k"),
                AllOf(HasSubstr("the method kfr has no such setting"), HasSubstr("sparse.k")));
    EXPECT_THAT(refused("kfr.alpha", "kfr.alhpa"), HasSubstr("did you mean 'kfr.alpha'"));
    EXPECT_THAT(refused("kfr.alpha", "acuity.border_px"), HasSubstr("no such setting"));
    EXPECT_THAT(refused("3.2]", "1e9]"), HasSubstr("kfr.sigma"));
    EXPECT_THAT(refused("\"kfr\"\nsess", "\"krf\"\nsess"), HasSubstr("krf"));
    EXPECT_THAT(refused("2afc", "3afc"), HasSubstr("unknown design"));
    EXPECT_FALSE(std::filesystem::exists(folder_.file("answers")));
}

// Whoever plans with a misspelt name would plan another study than they run.
TEST_F(StudyProgram, RefusesUnknownNamesInAPlanBeforeItIsSimulated) {
    const auto refused = [&](std::string_view from, std::string_view to,
                             const std::string& message) {
        std::string text = kPlan;
        text.replace(text.find(from), from.size(), to);
        const std::string plan = folder_.write("other.toml", text);
        const std::string answers = folder_.file("simulated.csv");
        for (const std::vector<std::string>& words :
             {std::vector<std::string>{"study", "power", plan, "--studies", "1"},
              {"study", "simulate", plan, answers}}) {
            const ProgramResult result = run_gazeloop(words);
            EXPECT_EQ(result.exit_code, 3) << result.err;
            EXPECT_THAT(result.err, AllOf(HasSubstr("other.toml:"), HasSubstr(message)));
        }
        EXPECT_FALSE(std::filesystem::exists(answers));
    };
    refused("sessions", "sesions", "did you mean 'sessions'");
    refused("kfr.alpha", "kfr.alhpa", "did you mean 'kfr.alpha'");
    refused("3.2]", "1e9]", "kfr.sigma = 1000000000: must lie in");
    refused("\"kfr\"\nsess", "\"krf\"\nsess", "did you mean 'kfr'");
    refused("[[factor]]", "[settings]\n\"render.nope\" = \"1\"\n[[factor]]", "render.nope");
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
    // Answers that are there are not replaced, unless by the same.
    EXPECT_EQ(run_gazeloop({"study", "simulate", plan, answers, "--threshold", "12"}).exit_code, 0);
    const ProgramResult other =
        run_gazeloop({"study", "simulate", plan, answers, "--threshold", "11"});
    EXPECT_EQ(other.exit_code, 3);
    EXPECT_THAT(other.err,
                HasSubstr("holds something else than these answers, which would be lost"));
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
