// Simulated gaze and display profiles, as users run them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

constexpr const char* kSmall = "render.scale=0.02";

std::vector<std::string> simulated(const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"run",      "--gaze",   "sim",     "--target",
                                       "headless", "--clock",  "virtual", "--set",
                                       kSmall,     "--frames", "20",      "--hash"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

TEST(SimulatedGaze, IsTheSameForTheSameSeed) {
    const ProgramResult a = run_gazeloop(simulated({"--seed", "18446744073709551615"}));
    const ProgramResult b = run_gazeloop(simulated({"--seed", "18446744073709551615"}));
    const ProgramResult c = run_gazeloop(simulated({"--seed", "0"}));
    ASSERT_EQ(a.exit_code, 0) << a.err;
    const auto hash = [](const ProgramResult& result) {
        return result.out.substr(result.out.find("hash foveae"));
    };
    EXPECT_EQ(hash(a), hash(b));
    EXPECT_NE(hash(a), hash(c));
    EXPECT_NE(a.out.find("tracker               modelled"), std::string::npos) << a.out;
}

TEST(SimulatedGaze, IsReplayedBitForBit) {
    const ScratchFolder folder;
    for (const char* display : {"valve_index", "fove0"}) {
        const std::string session = folder.file(std::string(display) + ".gaze");
        const ProgramResult run = run_gazeloop(
            {"run", "--gaze", "sim", "--tracker", "vive_pro_eye", "--display", display, "--target",
             "headless", "--set", kSmall, "--frames", "30", "--hash", "--record", session});
        ASSERT_EQ(run.exit_code, 0) << run.err;
        const ProgramResult replayed = run_gazeloop({"replay", session, "--hash"});
        EXPECT_EQ(replayed.exit_code, 0) << replayed.err;
        EXPECT_NE(replayed.out.find("foveae bit-equal in 30 of 30"), std::string::npos);
        EXPECT_NE(replayed.out.find("pictures equal in 30 of 30"), std::string::npos);
    }
}

/// What is made of the gaze learns from it as it goes: a replay must learn the same.
TEST(SimulatedGaze, IsReplayedBitForBitWhatIsMadeOfIt) {
    const ScratchFolder folder;
    for (const std::vector<std::string>& made :
         {std::vector<std::string>{"gaze.prediction=true"},
          {"gaze.filter=fixation", "gaze.events=true"},
          {"gaze.filter=one-euro", "gaze.prediction=true", "gaze.widen=true"}}) {
        const std::string session = folder.file(made.front() + ".gaze");
        std::vector<std::string> command{
            "run",      "--gaze",   "sim",  "--clock", "virtual",           "--target",
            "headless", "--set",    kSmall, "--set",   "sim.noise_deg=0.1", "--frames",
            "250",      "--record", session};
        for (const std::string& setting : made) {
            command.insert(command.end(), {"--set", setting});
        }
        const ProgramResult run = run_gazeloop(command);
        ASSERT_EQ(run.exit_code, 0) << run.err;
        const ProgramResult replayed = run_gazeloop({"replay", session});
        EXPECT_EQ(replayed.exit_code, 0) << replayed.err;
        EXPECT_NE(replayed.out.find("foveae bit-equal in 250 of 250"), std::string::npos)
            << made.front() << replayed.out;
    }
}

TEST(SimulatedGaze, RunsInAStandingHeadAndWithoutASample) {
    const ProgramResult still = run_gazeloop(
        simulated({"--set", "sim.head.sway_deg=0", "--set", "sim.head.turn_percent=0"}));
    EXPECT_EQ(still.exit_code, 0) << still.err;
    const ProgramResult lost = run_gazeloop(simulated({"--set", "sim.dropout_percent=100"}));
    EXPECT_EQ(lost.exit_code, 0) << lost.err;
    EXPECT_NE(lost.out.find("ahead 100.0 %"), std::string::npos) << lost.out;
}

TEST(SimulatedGaze, WritesTheTraceOfTheSameSource) {
    const ScratchFolder folder;
    const std::string trace = folder.file("gaze.csv");
    const ProgramResult written =
        run_gazeloop({"simulate", "gaze", trace, "--seconds", "2", "--seed", "3", "--rate", "200"});
    ASSERT_EQ(written.exit_code, 0) << written.err;
    EXPECT_NE(written.out.find("400 samples, 2 s at 200 Hz, seed 3"), std::string::npos);
    EXPECT_EQ(run_gazeloop({"replay", trace, "--frames", "5", "--set", kSmall}).exit_code, 0);
    const ProgramResult none = run_gazeloop(
        {"simulate", "gaze", trace, "--seconds", "1", "--set", "sim.dropout_percent=100"});
    EXPECT_EQ(none.exit_code, 2);
    EXPECT_NE(none.err.find("sim.dropout_percent"), std::string::npos);
}

// The middle of the emission is what is announced: looking at the top of a rolling display sees
// its photons earlier, at the bottom later, and in the middle neither.
TEST(RollingDisplay, CountsTheRowThatIsLookedAt) {
    const auto row_ms = [](const std::string& elevation, const std::string& display) {
        const ProgramResult run = run_gazeloop(
            {"run", "--gaze", "fixed:0," + elevation, "--target", "headless", "--clock", "virtual",
             "--frames", "5", "--set", kSmall, "--display", display, "--json", "-"});
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return nlohmann::json::parse(run.out)["durations"]["stage_scan_to_row"]["mean_ms"];
    };
    EXPECT_NEAR(row_ms("0", "fove0").get<double>(), 0.0, 1e-3);
    EXPECT_NEAR(row_ms("50", "fove0").get<double>(), -6.4, 0.01);
    EXPECT_NEAR(row_ms("-50", "fove0").get<double>(), 6.4, 0.01);
    EXPECT_NEAR(row_ms("-80", "fove0").get<double>(), 6.4, 0.01) << "off screen: the last row";
    EXPECT_EQ(row_ms("50", "quest_pro").get<double>(), 0.0) << "all rows at once";
}

TEST(RollingDisplay, IsTheSameInTheReport) {
    const ScratchFolder folder;
    const std::string session = folder.file("session.gaze");
    ASSERT_EQ(run_gazeloop(simulated({"--display", "psvr2", "--record", session})).exit_code, 0);
    const ProgramResult report = run_gazeloop({"report", session});
    EXPECT_EQ(report.exit_code, 0) << report.err;
    EXPECT_NE(report.out.find("scan to row         profile"), std::string::npos) << report.out;
    EXPECT_NE(report.out.find("A pixel is lit for 2.00 ms"), std::string::npos) << report.out;
    EXPECT_NE(report.out.find("Assumed, not published, in the display's profile: illumination"),
              std::string::npos)
        << report.out;
}

}  // namespace
}  // namespace gazeloop::tests
