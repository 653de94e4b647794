// report --against: what changed between two sessions, told from chance.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

using ::testing::HasSubstr;

class ComparedSessions : public testing::Test {
  protected:
    void SetUp() override {
        const ProgramResult made =
            run_gazeloop({"simulate", "gaze", trace_, "--seconds", "4", "--seed", "5"});
        ASSERT_EQ(made.exit_code, 0) << made.err;
    }

    /// A replay in virtual time, recorded.
    std::string replayed(const std::string& name, const std::vector<std::string>& options = {}) {
        const std::string session = folder_.file(name);
        std::vector<std::string> arguments{"replay",   trace_,  "--target", "headless",
                                           "--record", session, "--set",    "render.scale=0.05",
                                           "--quiet"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const ProgramResult result = run_gazeloop(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return session;
    }

    static nlohmann::json against(const std::string& after, const std::string& before) {
        const ProgramResult result =
            run_gazeloop({"report", after, "--against", before, "--json", "-"});
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return nlohmann::json::parse(result.out)["against"];
    }

    ScratchFolder folder_;
    std::string trace_ = folder_.file("trace.csv");
};

TEST_F(ComparedSessions, SameReplaysDifferByNothing) {
    const nlohmann::json json = against(replayed("a.gaze"), replayed("b.gaze"));
    for (const auto& [key, row] : json["rows"].items()) {
        EXPECT_TRUE(row["refused"].is_null()) << key;
        if (!key.starts_with("pass_") && !row["mean"].is_null()) {
            EXPECT_EQ(row["mean"]["change"], 0.0) << key;
            EXPECT_EQ(row["mean"]["may_be_chance"], true) << key;
        }
    }
    EXPECT_EQ(json["fovea_path"]["max_degrees"], 0.0);
    EXPECT_GT(json["fovea_path"]["compared"], 100);
    EXPECT_TRUE(json["disparities"].empty());
}

TEST_F(ComparedSessions, WithholdsPercentilesOfTooFewFrames) {
    const std::string one = folder_.file("one.gaze");
    ASSERT_EQ(
        run_gazeloop({"run", "--gaze", "fixed:0,0", "--clock", "virtual", "--target", "headless",
                      "--frames", "1", "--record", one, "--set", "render.scale=0.05"})
            .exit_code,
        0);
    const ProgramResult result = run_gazeloop({"report", one, "--against", one});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.out.find("(p50 -, p95 -,"), std::string::npos) << result.out;
    EXPECT_EQ(result.out.find("nan"), std::string::npos) << result.out;
}

TEST_F(ComparedSessions, AChangeIsSeenWithItsSetting) {
    const std::string before = replayed("a.gaze");
    // The GPU works 3 ms longer, of which nothing else depends in virtual time.
    const std::string after = replayed("b.gaze", {"--set", "virtual_time.gpu_ms=7"});
    const nlohmann::json json = against(after, before);
    const nlohmann::json& gpu = json["rows"]["stage_gpu"]["mean"];
    ASSERT_FALSE(gpu.is_null());
    EXPECT_EQ(gpu["may_be_chance"], false);
    EXPECT_NEAR(gpu["change"], 7.0 - gpu["before"].get<double>(), 1e-9);
    EXPECT_EQ(json["rows"]["gaze_age_at_latch"]["mean"]["change"], 0.0);
    ASSERT_EQ(json["disparities"].size(), 1U) << json["disparities"];
    EXPECT_EQ(json["disparities"][0]["what"], "virtual_time.gpu_ms");
    const ProgramResult text = run_gazeloop({"report", after, "--against", before});
    EXPECT_THAT(text.out, HasSubstr("compared with " + before));
    EXPECT_THAT(text.out, HasSubstr("virtual_time.gpu_ms"));
}

TEST_F(ComparedSessions, AnotherGazeMovesTheFovea) {
    const std::string before = replayed("a.gaze");
    const std::string after = replayed("b.gaze", {"--set", "gaze.fixation_distance_m=0.3"});
    const nlohmann::json json = against(after, before);
    EXPECT_TRUE(json["fovea_path"]["doubt"].is_null()) << json["fovea_path"];
    EXPECT_GT(json["fovea_path"]["max_degrees"], 0.0);
}

TEST_F(ComparedSessions, WhatIsNotComparableIsRefused) {
    const std::string modelled = replayed("a.gaze");
    const std::string timed = folder_.file("timed.gaze");
    const ProgramResult run =
        run_gazeloop({"run", "--gaze", "sim", "--target", "headless", "--frames", "20", "--record",
                      timed, "--set", "render.scale=0.05", "--quiet"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const ProgramResult result = run_gazeloop({"report", timed, "--against", modelled});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(result.err, HasSubstr(modelled));
    EXPECT_THAT(result.err, HasSubstr("virtual time"));
    const ProgramResult missing = run_gazeloop({"report", timed, "--against", "none.gaze"});
    EXPECT_EQ(missing.exit_code, 3);
    EXPECT_THAT(missing.err, HasSubstr("none.gaze"));
}

}  // namespace
}  // namespace gazeloop::tests
