// What a trace's reader found, said wherever a user looks: stderr, summary, JSON, session, `gaze`.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

constexpr const char* kSmall = "render.scale=0.05";

/// A SRanipal log, 120 Hz, both eyes look in the same two directions all the time.
std::string log_of(std::string_view left, std::string_view right) {
    std::string text =
        "time(100ns);eye_valid_L;eye_valid_R;openness_L;openness_R;gaze_origin_L.x(mm);"
        "gaze_origin_L.y(mm);gaze_origin_L.z(mm);gaze_origin_R.x(mm);gaze_origin_R.y(mm);"
        "gaze_origin_R.z(mm);gaze_direct_L.x;gaze_direct_L.y;gaze_direct_L.z;gaze_direct_R.x;"
        "gaze_direct_R.y;gaze_direct_R.z\n";
    for (int i = 0; i < 60; ++i) {
        text += fmt::format("{};31;31;.9;.9;33;2;-30;-31;1;-30;{};{}\n",
                            638'500'000'000'000'000 + i * 83'333LL, left, right);
    }
    return text;
}

class TraceReports : public testing::Test {
  private:
    ScratchFolder folder_;

  protected:
    std::string right_ = folder_.write("right.csv", log_of("-.02;0;1", ".02;0;1"));
    std::string mirrored_ = folder_.write("mirrored.csv", log_of(".02;0;1", "-.02;0;1"));
    std::string behind_ = folder_.write("behind.csv", log_of("-.02;0;-1", ".02;0;-1"));

    [[nodiscard]] const ScratchFolder& folder() const { return folder_; }
};

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST_F(TraceReports, SayWhatIsInATrace) {
    const ProgramResult result = run_gazeloop({"gaze", right_});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    for (const char* const line :
         {"format   htc-vive-pro, HTC Vive Pro\n", "rows     60, used 60\n",
          "rate     120 Hz for 0.4917 s\n", "eyes     left valid 100.0 %, right 100.0 %",
          "axes     agree with anatomy (left eye 64 mm left of", "found    nothing"}) {
        EXPECT_TRUE(has(result.out, line)) << line << result.out;
    }
    const ProgramResult program = run_gazeloop({"gaze", right_, "--json"});
    const auto json = nlohmann::json::parse(program.out);
    EXPECT_EQ(json["trace"]["rows"], 60);
    EXPECT_EQ(json["trace"]["used"], 60);
    EXPECT_TRUE(json["refused"].is_null());
}

TEST_F(TraceReports, RefuseGazeBehindTheHeadUntilItIsTurned) {
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"gaze", behind_},
          {"replay", behind_},
          {"run", "--target", "headless", "--gaze", "trace:" + behind_},
          {"simulate", "tracker", "--trace", behind_}}) {
        const ProgramResult result = run_gazeloop(command);
        EXPECT_EQ(result.exit_code, 3) << result.err;
        EXPECT_TRUE(has(result.err, behind_ + ": 100 % of the gaze points behind the head (+Z); "
                                              "--axes -z makes it agree"))
            << result.err;
    }
    const ProgramResult turned = run_gazeloop({"gaze", behind_, "--axes", "-z"});
    EXPECT_EQ(turned.exit_code, 0) << turned.err;
    EXPECT_TRUE(has(turned.out, "corrected by --axes -z: agree with anatomy")) << turned.out;
}

TEST_F(TraceReports, WarnOfMirroredGazeEverywhere) {
    const std::string session = folder().file("s.gaze");
    const ProgramResult result =
        run_gazeloop({"replay", mirrored_, "--frames", "3", "--set", kSmall, "--record", session});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(has(result.err, "warning: " + mirrored_ + ": axes: the eyes' rays diverge"))
        << result.err;
    EXPECT_TRUE(has(result.err, "--axes -x makes it agree")) << result.err;
    EXPECT_TRUE(has(result.out,
                    "trace    rows 60, used 60, lost by the tracker unknown\n         clock: the "
                    "device's; no host times\n"
                    "         axes: the eyes' rays diverge"))
        << result.out;
    const ProgramResult report = run_gazeloop({"report", session});
    EXPECT_TRUE(has(report.out,
                    "trace    rows 60, used 60, lost by the tracker unknown\n         clock: the "
                    "device's; no host times\n"
                    "         axes: the eyes' rays diverge"))
        << report.out;
    const auto json = nlohmann::json::parse(run_gazeloop({"report", session, "--json", "-"}).out);
    EXPECT_EQ(json["trace"]["clock"], "the device's; no host times");
    EXPECT_EQ(json["trace"]["findings"].size(), 1U) << json["trace"];
    EXPECT_EQ(json["trace"]["findings"][0]["kind"], "axes");
    // What was played is what the session holds.
    const ProgramResult gaze = run_gazeloop({"gaze", session});
    EXPECT_EQ(gaze.exit_code, 0) << gaze.err;
    EXPECT_TRUE(has(gaze.out, "format   session")) << gaze.out;
}

/// The run's JSON and its session's are one computation.
TEST_F(TraceReports, AreTheSameInARunAndItsSession) {
    const std::string session = folder().file("s.gaze");
    const ProgramResult run =
        run_gazeloop({"run", "--gaze", "trace:" + mirrored_, "--axes", "-x", "--target", "headless",
                      "--frames", "3", "--set", kSmall, "--record", session, "--json", "-"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const auto of_run = nlohmann::json::parse(run.out);
    const auto of_session =
        nlohmann::json::parse(run_gazeloop({"report", session, "--json", "-"}).out);
    EXPECT_EQ(of_run["trace"], of_session["trace"]);
    EXPECT_EQ(of_run["directions"], of_session["directions"]);
    EXPECT_TRUE(
        has(of_run["directions"].get<std::string>(), "corrected by --axes -x: agree with anatomy"))
        << of_run["directions"];
    EXPECT_TRUE(of_run["trace"]["lost_by_tracker"].is_null()) << "its rows have no numbers";
    EXPECT_TRUE(of_run["trace"]["dropped"].empty());
}

/// No trace, nothing to say.
TEST_F(TraceReports, AreNullWithoutATrace) {
    const ProgramResult run = run_gazeloop({"run", "--gaze", "fixed:1,2", "--target", "headless",
                                            "--frames", "2", "--set", kSmall, "--json", "-"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    EXPECT_TRUE(json["trace"].is_null());
    EXPECT_TRUE(json["directions"].is_null());
}

/// A simulated person's eyes are a person's.
TEST_F(TraceReports, LookAtLiveGazeToo) {
    const ProgramResult run =
        run_gazeloop({"run", "--gaze", "sim", "--clock", "virtual", "--target", "headless",
                      "--seconds", "4", "--set", kSmall, "--json", "-"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    ASSERT_TRUE(json["directions"].is_string()) << run.err;
    EXPECT_TRUE(has(json["directions"].get<std::string>(), "agree with anatomy"));
    EXPECT_TRUE(has(run.err, "tracker: directions: agree with anatomy")) << run.err;
}

TEST_F(TraceReports, KnowTheirOptions) {
    const ProgramResult wrong = run_gazeloop({"gaze", right_, "--axes", "-y"});
    EXPECT_EQ(wrong.exit_code, 2);
    const ProgramResult wrong_in_run = run_gazeloop({"replay", right_, "--axes", "-y"});
    EXPECT_EQ(wrong_in_run.exit_code, 2);
    EXPECT_TRUE(has(wrong_in_run.err, "swap-eyes")) << wrong_in_run.err;
    const ProgramResult config =
        run_gazeloop({"replay", right_, "--axes", "-x", "--accept-repairs", "--print-config"});
    EXPECT_TRUE(has(config.out, "trace.axes                   = '-x' ")) << config.out;
    EXPECT_TRUE(has(config.out, "trace.accept_repairs         = true ")) << config.out;
    const ProgramResult help = run_gazeloop({"gaze", "--help"});
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_TRUE(has(help.out, "--accept-repairs")) << help.out;
    EXPECT_EQ(run_gazeloop({"gaze", "/nowhere/t.csv"}).exit_code, 3);
}

}  // namespace
}  // namespace gazeloop::tests
