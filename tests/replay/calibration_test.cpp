// The program as its users run it: calibrating a simulated person's tracker, and using that.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "runtime/session/session_file.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

/// Some 3 to 5 deg off, growing outwards.
const std::vector<std::string> kTracker{
    "--set", "sim.bias_deg=2",    "--set",  "sim.bias_growth_percent=2",
    "--set", "sim.noise_deg=0.3", "--seed", "3"};

class CalibrationProgram : public testing::Test {
  protected:
    ProgramResult calibrate(const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"calibrate",
                                           "--gaze",
                                           "sim",
                                           "--target",
                                           "headless",
                                           "--clock",
                                           "virtual",
                                           "--set",
                                           "render.scale=0.02",
                                           "--out",
                                           file_,
                                           "--json",
                                           folder_.file("c.json")};
        arguments.insert(arguments.end(), kTracker.begin(), kTracker.end());
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_gazeloop(arguments);
    }
    nlohmann::json result() {
        std::ifstream in(folder_.file("c.json"));
        return nlohmann::json::parse(in);
    }

    ScratchFolder folder_;
    std::string file_ = folder_.file("me.toml");
};

TEST_F(CalibrationProgram, TakesTheErrorOfASimulatedTrackerAway) {
    const ProgramResult made = calibrate({});
    ASSERT_EQ(made.exit_code, 0) << made.err << made.out;
    EXPECT_NE(made.out.find("Look at the white dot"), std::string::npos) << made.out;
    EXPECT_NE(made.out.find("applies it"), std::string::npos) << made.out;
    struct stat status{};
    ASSERT_EQ(stat(file_.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, 0600U);
    const nlohmann::json json = result();
    EXPECT_EQ(json["file"], file_);
    for (const char* eye : {"left", "right"}) {
        EXPECT_EQ(json[eye]["points"], 9) << json.dump(2);
        EXPECT_GT(json[eye]["before_median_deg"], 2.0) << json.dump(2);
        EXPECT_LT(json[eye]["leave_one_out_median_deg"], 0.7) << json.dump(2);
        EXPECT_TRUE(json[eye]["points_left_out"].empty()) << json.dump(2);
    }

    // Used: the foveae move by as much as the tracker was off, and the session needs no file.
    const auto run = [&](const std::string& session, std::vector<std::string> more) {
        std::vector<std::string> arguments{
            "run",      "--gaze", "sim",      "--target", "headless", "--clock",          "virtual",
            "--frames", "60",     "--record", session,    "--set",    "render.scale=0.02"};
        arguments.insert(arguments.end(), kTracker.begin(), kTracker.end());
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProgramResult ran = run_gazeloop(arguments);
        EXPECT_EQ(ran.exit_code, 0) << ran.err;
        return value_or_throw(session::read_session(session));
    };
    const session::SessionFile plain = run(folder_.file("plain.gaze"), {});
    const session::SessionFile used =
        run(folder_.file("used.gaze"), {"--set", "gaze.calibration=" + file_});
    std::filesystem::remove(file_);
    ASSERT_EQ(plain.samples.size(), used.samples.size());
    double greatest_deg = 0.0;
    for (std::size_t i = 0; i < used.samples.size(); ++i) {
        const auto& before = plain.samples[i].sample.eyes[0];
        const auto& after = used.samples[i].sample.eyes[0];
        if (before.valid) {
            const double cosine = std::clamp(glm::dot(before.direction, after.direction), -1., 1.);
            greatest_deg = std::max(greatest_deg, std::acos(cosine) * 57.29577951308232);
        }
    }
    EXPECT_GT(greatest_deg, json["left"]["before_median_deg"].get<double>() / 2.0);
    const auto values =
        std::ranges::find(used.header.config, "gaze.calibration_values", &NamedValue::name);
    ASSERT_NE(values, used.header.config.end());
    EXPECT_EQ(std::ranges::count(values->value, ','), 25);
    for (const std::vector<std::string>& clock :
         {std::vector<std::string>{}, std::vector<std::string>{"--clock", "virtual"}}) {
        std::vector<std::string> arguments{"replay", folder_.file("used.gaze"), "--target",
                                           "headless"};
        arguments.insert(arguments.end(), clock.begin(), clock.end());
        const ProgramResult replay = run_gazeloop(arguments);
        EXPECT_EQ(replay.exit_code, 0) << replay.err << replay.out;
    }
}

TEST_F(CalibrationProgram, LeavesOutAPointThatWasNotLookedAt) {
    const ProgramResult made = calibrate({"--bad-point", "4"});
    ASSERT_EQ(made.exit_code, 0) << made.err << made.out;
    const nlohmann::json json = result();
    for (const char* eye : {"left", "right"}) {
        EXPECT_EQ(json[eye]["points_left_out"], nlohmann::json{4}) << json.dump(2);
        EXPECT_LT(json[eye]["leave_one_out_median_deg"], 1.0) << json.dump(2);
    }
    EXPECT_NE(made.out.find("point 4 was left out"), std::string::npos) << made.out;
}

TEST_F(CalibrationProgram, WritesNothingWithoutGaze) {
    const ProgramResult made = calibrate({"--set", "sim.dropout_percent=100"});
    EXPECT_EQ(made.exit_code, 1) << made.err << made.out;
    EXPECT_NE(made.out.find("NOT CALIBRATED: 0 points with steady gaze, 7 are needed"),
              std::string::npos)
        << made.out;
    EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(CalibrationProgram, RefusesAFileThatIsNone) {
    const std::string bad = folder_.write("bad.toml", "format = \"other\"\n");
    const ProgramResult run = run_gazeloop(
        {"run", "--gaze", "sim", "--target", "headless", "--set", "gaze.calibration=" + bad});
    EXPECT_EQ(run.exit_code, 3) << run.err;
    EXPECT_NE(run.err.find(bad + ": is no calibration"), std::string::npos) << run.err;
    const ProgramResult values = run_gazeloop(
        {"run", "--gaze", "sim", "--target", "headless", "--set", "gaze.calibration_values=1,2,3"});
    EXPECT_EQ(values.exit_code, 2) << values.err;
    EXPECT_NE(values.err.find("3 numbers"), std::string::npos) << values.err;
}

}  // namespace
}  // namespace gazeloop::tests
