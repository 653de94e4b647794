// Budgets as users meet them: a run that is watched, what it says, and what a report makes of it.
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "runtime/session/playback.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

using nlohmann::json;

std::string read_text(const std::string& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<json> lines_of(const std::string& text) {
    std::vector<json> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        lines.push_back(json::parse(line));
    }
    return lines;
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

class Monitor : public testing::Test {
  protected:
    /// gazeloop run in a shell that redirects its descriptors.
    [[nodiscard]] ProgramResult run(const std::vector<std::string>& more,
                                    const std::string& redirection) const {
        std::vector<std::string> words{"run", "--target", "headless",         "--gaze",
                                       "sim", "--set",    "render.scale=0.05"};
        words.insert(words.end(), more.begin(), more.end());
        return run_gazeloop(words, {.wrapper = {"sh", "-c", "exec \"$@\" " + redirection, "sh"},
                                    .timeout = std::chrono::seconds(100)});
    }
    /// The lines of a run in virtual time, whose frames wait 11 ms for the display after 8 on the
    /// GPU: modelled, and the same each time.
    [[nodiscard]] std::vector<json> lines_of_run(std::vector<std::string> more) {
        more.insert(more.end(), {"--clock", "virtual", "--monitor-json", "3", "--record",
                                 folder_.file("session.gaze")});
        result_ = run(more, "3>" + folder_.file("lines.jsonl"));
        EXPECT_EQ(result_.exit_code, 0) << result_.err;
        return lines_of(read_text(folder_.file("lines.jsonl")));
    }

    ScratchFolder folder_;
    ProgramResult result_;
};

TEST_F(Monitor, WritesLinesAndEventsOfARunThatBreaksItsBudget) {
    const std::vector<json> lines = lines_of_run({"--budget", "strict", "--frames", "210"});
    ASSERT_GE(lines.size(), 5U);
    EXPECT_EQ(lines.front()["what"], "begin");
    EXPECT_EQ(lines.front()["clock"], "virtual");
    EXPECT_EQ(lines.front()["budget"]["name"], "strict");
    EXPECT_EQ(lines.back()["what"], "end");
    EXPECT_EQ(lines.back()["frames"], 210);
    std::size_t intervals = 0;
    std::string broken;
    for (const json& line : lines) {
        intervals += line["what"] == "interval" ? 1 : 0;
        if (line["what"] == "event" && line["kind"] == "budget-broken") {
            broken += line["text"].get<std::string>() + "\n";
        }
    }
    EXPECT_GE(intervals, 2U) << "three seconds of 70 Hz";
    EXPECT_TRUE(has(broken, "gpu above the allowed 5.00 ms: p95 8.00 ms")) << broken;
    const json& gpu = lines.back()["parts"]["gpu"];
    EXPECT_EQ(gpu["broken"], true);
    EXPECT_EQ(gpu["p95_ms"], 8.0);
    EXPECT_EQ(gpu["run"]["above"], gpu["run"]["known"]);
    EXPECT_EQ(lines.back()["lines_dropped"], 0);

    // The same in log, summary, session and its report.
    EXPECT_TRUE(has(result_.err, "budget-broken: gpu above")) << result_.err;
    EXPECT_TRUE(has(result_.out, "budget strict")) << result_.out;
    EXPECT_TRUE(has(result_.out, "longest run")) << result_.out;
    const ProgramResult report = run_gazeloop({"report", folder_.file("session.gaze")});
    EXPECT_EQ(report.exit_code, 0) << report.err;
    EXPECT_TRUE(has(report.out, "budget-broken")) << report.out;
}

/// What the frames of a session say of the budget.
class Budgets final : public frame::FrameObserver {
  public:
    void on_frame(const frame::FrameRecord& frame) override {
        ++frames;
        with_22_ms += frame.budget_ns == 22'000'000 ? 1 : 0;
    }
    int frames = 0;
    int with_22_ms = 0;
};

TEST_F(Monitor, RecordsTheBudgetInForceAndReplaysIt) {
    (void)lines_of_run({"--budget", "strict", "--frames", "30"});
    Budgets budgets;
    const std::array<frame::FrameObserver*, 1> observers{&budgets};
    ASSERT_TRUE(
        session::play(std::filesystem::path(folder_.file("session.gaze")), observers).has_value());
    EXPECT_EQ(budgets.frames, 30);
    EXPECT_EQ(budgets.with_22_ms, 30);
    // The recording says no budget to its replay: who watches it decides.
    const ProgramResult replay =
        run_gazeloop({"replay", folder_.file("session.gaze"), "--budget", "albert2017"});
    EXPECT_EQ(replay.exit_code, 0) << replay.err;
    EXPECT_TRUE(has(replay.out, "budget albert2017")) << replay.out;
}

TEST_F(Monitor, DecidesTheExitCodeOfAReport) {
    (void)lines_of_run({"--frames", "140"});
    const std::string session = folder_.file("session.gaze");
    const ProgramResult kept = run_gazeloop({"report", session, "--budget", "albert2017"});
    EXPECT_EQ(kept.exit_code, 0) << kept.err;
    EXPECT_TRUE(has(kept.out, "budget albert2017")) << kept.out;
    const ProgramResult broken = run_gazeloop({"report", session, "--budget", "strict"});
    EXPECT_EQ(broken.exit_code, 1);
    EXPECT_TRUE(has(broken.err, "budget strict broken: ")) << broken.err;
    EXPECT_TRUE(has(broken.err, "gpu: p95 8.0")) << broken.err;
    const ProgramResult number =
        run_gazeloop({"report", session, "--budget-ms", "1", "--json", folder_.file("r.json")});
    EXPECT_EQ(number.exit_code, 1);
    EXPECT_TRUE(has(number.err, "budget of 1 ms broken: gaze age at display")) << number.err;
    const json written = json::parse(read_text(folder_.file("r.json")));
    EXPECT_EQ(written["budget"]["kept"], false);
    EXPECT_EQ(written["budget"]["parts"]["gaze_age_at_display"]["verdict"], "broken");
}

TEST_F(Monitor, JudgesNothingByTooFewFrames) {
    (void)lines_of_run({"--frames", "5"});
    const ProgramResult few =
        run_gazeloop({"report", folder_.file("session.gaze"), "--budget", "albert2017"});
    EXPECT_EQ(few.exit_code, 1);
    EXPECT_TRUE(has(few.err, "not judgeable")) << few.err;
}

TEST_F(Monitor, IsHeldUpByNobody) {
    const ProgramResult slow = run_gazeloop(
        {"run", "--target", "headless", "--gaze", "sim", "--set", "render.scale=0.05", "--clock",
         "virtual", "--frames", "400", "--budget", "strict", "--set", "monitor.interval_s=0.01",
         "--monitor-json", "3"},
        // Open for both, so that it opens at once, and nobody reads.
        {.wrapper = {"sh", "-c", "mkfifo \"$0\" && exec \"$@\" 3<>\"$0\"", folder_.file("fifo")},
         .timeout = std::chrono::seconds(60)});
    EXPECT_EQ(slow.exit_code, 0) << slow.err;
    EXPECT_TRUE(has(slow.err, "lines dropped")) << slow.err;
}

TEST_F(Monitor, SaysALineASecondWhereThereIsNoTerminal) {
    const ProgramResult result =
        run({"--seconds", "2.5", "--budget", "strict", "--monitor", "--quiet"}, "");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(has(result.err, "monitor: gaze age at display p50 ")) << result.err;
    EXPECT_TRUE(has(result.err, "budget strict:")) << result.err;
    EXPECT_FALSE(has(result.err, "\x1b")) << result.err;
}

}  // namespace
}  // namespace gazeloop::tests
