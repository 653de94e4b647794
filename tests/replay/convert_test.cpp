// Traces of other programs, through the program as users run it: replay, gaze, convert.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/recorded_data.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// gaze.csv of Pupil Labs, 200 Hz: places that change every 300 ms; row 100 has no angles.
std::string pupil_labs(int rows, double late_ms = 0.0) {
    std::string text = "timestamp [ns],worn,blink id,azimuth [deg],elevation [deg]\n";
    for (int i = 0; i < rows; ++i) {
        const double step = std::floor((5.0 * i - late_ms) / 300.0);
        text += fmt::format("{},1,{},{},{}\n", 1'700'000'000'000'000'000 + i * 5'000'000LL,
                            i >= 40 && i < 60 ? "1" : "",
                            i == 100 ? "abc" : fmt::format("{:.3f}", 12.0 * std::sin(1.7 * step)),
                            i == 100 ? "" : fmt::format("{:.3f}", 8.0 * std::sin(2.9 * step)));
    }
    return text;
}

TEST(Convert, WritesEveryFormatAndReadsItAgain) {
    const ScratchFolder folder;
    const std::string in = folder.write("gaze.csv", pupil_labs(400));
    const std::string native = folder.file("native.csv.gz");
    const std::string angles = folder.file("angles.csv");
    const std::string bids = folder.file("ds");
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"convert", in, native},
          {"convert", native, angles, "--to", "angles"},
          {"convert", angles, bids, "--to", "bids", "--subject", "7", "--task", "look"}}) {
        const ProgramResult result = run_gazeloop(command);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        EXPECT_TRUE(has(result.out, "wrote    " + command[2])) << result.out;
    }
    const std::string recording = bids + "/sub-7/beh/sub-7_task-look_recording-eye1_physio.tsv.gz";
    for (const std::string& file : {in, native, angles, recording}) {
        const Json json = Json::parse(run_gazeloop({"gaze", file, "--json"}).out);
        EXPECT_EQ(json["samples"], 400) << file;
        EXPECT_NEAR(json["rate_hz"].get<double>(), 200.0, 1e-6) << file;
        EXPECT_NEAR(json["valid_percent"]["both"].get<double>(), 100.0 * 379.0 / 400.0, 1e-6)
            << file;
        EXPECT_EQ(json["losses"]["count"], 2) << file;
        const ProgramResult played =
            run_gazeloop({"replay", file, "--frames", "3", "--set", "render.scale=0.02"});
        EXPECT_EQ(played.exit_code, 0) << file << played.err;
    }
}

TEST(Convert, CountsByReasonAndLine) {
    const ScratchFolder folder;
    const std::string in = folder.write("gaze.csv", pupil_labs(400));
    const ProgramResult result =
        run_gazeloop({"convert", in, folder.file("out.csv"), "--json", "-"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const Json json = Json::parse(result.out);
    EXPECT_EQ(json["written"]["format"], "gazeloop");
    EXPECT_EQ(json["written"]["files"].size(), 2U);
    std::vector<std::string> counts;
    for (const Json& count : json["counts"]) {
        counts.push_back(fmt::format("{}: {} rows, {} dropped", count["kind"].get<std::string>(),
                                     count["rows"].dump(), count["dropped"].dump()));
    }
    EXPECT_EQ(counts, (std::vector<std::string>{"bad cells: 2 rows, 0 dropped",
                                                "refused by bit: 20 rows, 0 dropped"}));
    std::vector<int> lines;
    for (const Json& finding : json["trace"]["findings"]) {
        lines.push_back(finding["line"].get<int>());
    }
    EXPECT_EQ(lines, (std::vector<int>{102, 102, 42})) << "each eye's cell, then the blink";
}

TEST(Convert, SaysWhatHasNoPlace) {
    const ScratchFolder folder;
    const std::string in = folder.file("in.csv");
    ASSERT_EQ(run_gazeloop({"simulate", "gaze", in, "--seconds", "1", "--seed", "1"}).exit_code, 0);
    // The tracker loses two samples.
    std::ifstream whole(in);
    std::string text;
    std::string line;
    for (int row = 0; std::getline(whole, line); ++row) {
        text += row == 50 || row == 51 ? "" : line + '\n';
    }
    const std::string lossy = folder.write("lossy.csv", text);
    for (const std::string to : {"angles", "bids"}) {
        const ProgramResult result =
            run_gazeloop({"convert", lossy, folder.file(to), "--to", to, "--json", "-"});
        ASSERT_EQ(result.exit_code, 0) << result.err;
        const std::string left_out = Json::parse(result.out)["written"]["left_out"].dump();
        EXPECT_TRUE(has(left_out, "when samples arrived")) << left_out;
        EXPECT_TRUE(has(left_out, "by which it lost 2")) << left_out;
    }
    const ProgramResult native =
        run_gazeloop({"convert", lossy, folder.file("native.csv"), "--json", "-"});
    EXPECT_TRUE(Json::parse(native.out)["written"]["left_out"].empty());
}

TEST(Convert, RefusesWithTheRightCode) {
    const ScratchFolder folder;
    const std::string in = folder.write("gaze.csv", pupil_labs(400));
    const std::string pixels = folder.write("px.csv", "t_ms,x_px,y_px\n0,1,2\n2,1,2\n");
    const std::string out = folder.file("out.csv");
    EXPECT_EQ(run_gazeloop({"convert", in}).exit_code, 2);
    EXPECT_EQ(run_gazeloop({"convert", in, out, "--to", "xdf"}).exit_code, 2);
    EXPECT_EQ(run_gazeloop({"convert", folder.file("none.csv"), out}).exit_code, 3);
    const ProgramResult refused = run_gazeloop({"convert", pixels, out});
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_TRUE(has(refused.err, "pixels have no direction without screen_size_m")) << refused.err;
    EXPECT_FALSE(fs::exists(out));
    EXPECT_EQ(run_gazeloop({"convert", in, in}).exit_code, 2);
    EXPECT_EQ(run_gazeloop({"convert", in, out, "--json", in}).exit_code, 2);
    EXPECT_EQ(run_gazeloop({"gaze", in, "--json", in}).exit_code, 2);
    EXPECT_EQ(fs::file_size(in), pupil_labs(400).size());
    EXPECT_EQ(run_gazeloop({"convert", in, "/nonexistent/o.csv"}).exit_code, 3);
    EXPECT_EQ(
        run_gazeloop({"convert", in, folder.file("d"), "--to", "bids", "--task", "a b"}).exit_code,
        2);
}

TEST(GazeCommand, ComparesTwoRecordings) {
    const ScratchFolder folder;
    const std::string one = folder.write("one.csv", pupil_labs(6000));
    const std::string other = folder.write("other.csv", pupil_labs(6000, 40.0));
    const ProgramResult result = run_gazeloop({"gaze", one, other, "--json", "-"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const Json json = Json::parse(result.out)["comparison"];
    EXPECT_NEAR(json["lag_ms"].get<double>(), 40.0, 1.0) << result.out;
    EXPECT_NEAR(json["azimuth"]["gain"].get<double>(), 1.0, 0.02);
    EXPECT_TRUE(json["lag_interval_ms"].is_array());
    const ProgramResult text = run_gazeloop({"gaze", one, other});
    EXPECT_TRUE(has(text.out, "lag      the second is +4")) << text.out;
}

TEST(RecordedTraces, AllReplay) {
    if (const std::string missing = no_recorded_data("traces"); !missing.empty()) {
        GTEST_SKIP() << missing;
    }
    const fs::path traces = recorded_data("traces");
    for (const char* const file :
         {"andersson2017/dots/TH20_trial1.csv", "andersson2017/img/TH34_img_Europe.csv",
          "htc_vive_pro/TESTNA05_360VR_Spread7.csv", "pico_neo_3/boxing_VR.csv",
          "pupil_invisible/trampoline_02/gaze.csv", "tobii_glasses_3/gazedata.gz"}) {
        const ProgramResult played = run_gazeloop(
            {"replay", (traces / file).string(), "--frames", "3", "--set", "render.scale=0.02"});
        EXPECT_EQ(played.exit_code, 0) << file << played.err;
        EXPECT_TRUE(has(played.out, "trace    rows ")) << file << played.out;
    }
}

}  // namespace
}  // namespace gazeloop::tests
