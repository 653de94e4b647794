// The program as its users run it, on an emulated eye service of a Steam Frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>

#include "runtime/session/session_file.h"
#include "tests/support/background_process.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

class SteamFrameProgram : public testing::Test {
  protected:
    [[nodiscard]] BackgroundProcess::Options service(std::vector<std::string> more = {}) const {
        std::vector<std::string> command{
            GAZELOOP_BINARY_DIR "/gazeloop", "simulate", "steam-frame", file_, "--seed", "7"};
        command.insert(command.end(), more.begin(), more.end());
        return {.command = command, .environment = {}, .output_file = folder_.file("service.log")};
    }

    ScratchFolder folder_;
    std::string file_ = folder_.file("eye-server.mmap");
};

TEST_F(SteamFrameProgram, RecordsWhatTheServiceStatesAndReplaysIt) {
    BackgroundProcess simulated(service());
    ASSERT_TRUE(simulated.says("publishing in", std::chrono::seconds(30))) << simulated.output();
    const std::string session = folder_.file("session.gaze");
    const ProgramResult run =
        run_gazeloop({"run", "--gaze", "steam-frame:" + file_, "--target", "headless", "--seconds",
                      "3", "--record", session, "--set", "render.scale=0.05"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.err.find("not tried on hardware"), std::string::npos) << run.err;
    simulated.signal(SIGINT);
    EXPECT_EQ(simulated.wait(std::chrono::seconds(20)), 130) << simulated.output();

    const session::SessionFile file = value_or_throw(session::read_session(session));
    ASSERT_GT(file.samples.size(), 20U);
    std::size_t stated = 0;
    for (const auto& [frame, sample] : file.samples) {
        EXPECT_EQ(sample.processing, gaze::GazeProcessing::Filtered);
        EXPECT_EQ(sample.sampled.kind, time::StampKind::Measured);
        stated += sample.eyes[0].covariance.has_value() ? 1 : 0;
    }
    EXPECT_GT(stated, file.samples.size() / 2) << "but in blinks";
    EXPECT_TRUE(std::ranges::any_of(file.frames, [](const auto& shown) {
        return shown.frame.fovea.eyes[0].state == gaze::FoveaState::Tracking;
    }));
    const ProgramResult replay = run_gazeloop({"replay", session, "--target", "headless"});
    EXPECT_EQ(replay.exit_code, 0) << replay.err << replay.out;
}

TEST_F(SteamFrameProgram, IsListedWithWhatItStates) {
    const std::vector<std::string> devices{"devices", "--seconds", "1", "--set",
                                           "steam_frame.file=" + file_};
    std::vector<std::string> json = devices;
    json.emplace_back("--json");
    BackgroundProcess simulated(service({"--layout", "4"}));
    ASSERT_TRUE(simulated.says("publishing in", std::chrono::seconds(30))) << simulated.output();
    const ProgramResult listed = run_gazeloop(json);
    ASSERT_EQ(listed.exit_code, 0) << listed.err << listed.out;
    const auto list = nlohmann::json::parse(listed.out);
    const auto found = std::ranges::find_if(
        list, [](const auto& entry) { return entry["source"] == "steam-frame"; });
    ASSERT_NE(found, list.end()) << list.dump(2);
    EXPECT_EQ((*found)["path"], file_);
    EXPECT_TRUE((*found)["vendor"].is_null());
    EXPECT_GT((*found)["samples_with_gaze"], 0);
    EXPECT_FALSE((*found)["tried_on_hardware"]);
    EXPECT_TRUE((*found)["problems"].empty()) << list.dump(2);
    const ProgramResult text = run_gazeloop(devices);
    EXPECT_NE(text.out.find("layout of version 4 (build 20260921)"), std::string::npos) << text.out;
}

TEST_F(SteamFrameProgram, RefusesAVersionThatItDoesNotKnow) {
    BackgroundProcess simulated(service({"--layout", "9"}));
    ASSERT_TRUE(simulated.says("publishing in", std::chrono::seconds(30))) << simulated.output();
    const ProgramResult listed =
        run_gazeloop({"devices", "--seconds", "0.2", "--set", "steam_frame.file=" + file_});
    EXPECT_EQ(listed.exit_code, 4) << listed.err;
    EXPECT_NE(listed.out.find("writes version 9 of its file"), std::string::npos) << listed.out;
    const ProgramResult run =
        run_gazeloop({"run", "--gaze", "steam-frame:" + file_, "--target", "headless", "--seconds",
                      "0.5", "--set", "render.scale=0.02", "--log-level", "warn"});
    EXPECT_EQ(run.exit_code, 4) << run.err;
    EXPECT_NE(run.err.find("warning: tracker-fault: the eye service writes version 9"),
              std::string::npos)
        << run.err;
    EXPECT_NE(run.err.find("no gaze came: the eye service writes version 9"), std::string::npos)
        << run.err;
    const ProgramResult second = run_gazeloop({"simulate", "steam-frame", file_});
    EXPECT_EQ(second.exit_code, 3) << second.err;
    EXPECT_NE(second.err.find("is there already"), std::string::npos) << second.err;
}

TEST_F(SteamFrameProgram, BringsItsTrackersProfile) {
    const ProgramResult run = run_gazeloop({"run", "--gaze", "steam-frame", "--print-config"});
    EXPECT_NE(run.out.find("steam_frame"), std::string::npos);
    const std::size_t at = run.out.find("profile.tracker");
    EXPECT_NE(run.out.substr(at, run.out.find('\n', at) - at).find("--gaze steam-frame"),
              std::string::npos)
        << run.out;
}

}  // namespace
}  // namespace gazeloop::tests
