// A governed run as its users start it, and its recording replayed. In virtual time frames take
// what virtual_time.gpu_ms says by any level, so that what the governor does is the same
// everywhere.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "runtime/session/cursor.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

using testing::HasSubstr;

constexpr const char* kFront = R"(figure = "contrast"

[[level]]
method = "full"
ms = 9
loss = 0.5

[[level]]
method = "kfr"
set = "kfr.sigma=1.8 kfr.alpha=4"
ms = 4
loss = 1

[[level]]
method = "acuity"
set = "acuity.mar=0.1"
ms = 2
loss = 4
)";

class GovernedProgram : public testing::Test {
  protected:
    ProgramResult run(const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"run",
                                           "--gaze",
                                           "fixed:3,2",
                                           "--target",
                                           "headless",
                                           "--clock",
                                           "virtual",
                                           "--frames",
                                           "40",
                                           "--set",
                                           "render.scale=0.04",
                                           "--governor",
                                           "--set",
                                           "governor.front=" + front_};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_gazeloop(arguments);
    }

    ScratchFolder folder_;
    std::string front_ = folder_.write("front.toml", kFront);
    std::string session_ = folder_.file("session.gaze");
};

std::vector<std::optional<std::uint8_t>> levels_of(const std::string& file) {
    const auto session = session::OpenSession::open(file);
    std::vector<std::optional<std::uint8_t>> levels;
    session::FrameCursor frames(*session);
    while (frames.next().value()) {
        levels.push_back(frames.row()->frame.quality_level);
    }
    return levels;
}

TEST_F(GovernedProgram, MovesAndIsReplayedBitForBit) {
    const ProgramResult ran =
        run({"--record", session_, "--hash", "--set", "virtual_time.gpu_ms=20"});
    ASSERT_EQ(ran.exit_code, 0) << ran.err << ran.out;
    EXPECT_THAT(ran.out, HasSubstr("the governor held level 3 of 3: acuity acuity.mar=0.1"));
    EXPECT_THAT(ran.out, HasSubstr("over the budget: 20.00 ms of 12.86"));
    EXPECT_THAT(ran.out, HasSubstr("quality-floor"));

    const auto levels = levels_of(session_);
    ASSERT_EQ(levels.size(), 40U);
    EXPECT_EQ(levels.front(), 0);
    EXPECT_EQ(levels.back(), 2);

    // Without the front's file and without a decision.
    ASSERT_TRUE(std::filesystem::remove(front_));
    for (const char* const gpu_ms : {"20", "1"}) {
        const ProgramResult again = run_gazeloop(
            {"replay", session_, "--hash", "--set", std::string("virtual_time.gpu_ms=") + gpu_ms,
             "--record", folder_.file(std::string("again") + gpu_ms)});
        EXPECT_EQ(again.exit_code, 0) << again.err << again.out;
        EXPECT_THAT(again.out, HasSubstr("pixel")) << again.out;
        EXPECT_EQ(levels_of(folder_.file(std::string("again") + gpu_ms)), levels);
    }
    const ProgramResult other =
        run_gazeloop({"replay", session_, "--set", "governor.front=raymarch"});
    EXPECT_EQ(other.exit_code, 2) << other.out;
    EXPECT_THAT(other.err, HasSubstr("by the levels that were recorded"));
    const std::string json = folder_.file("report.json");
    const std::string page = folder_.file("report.html");
    const ProgramResult report = run_gazeloop({"report", session_, "--json", json, "--html", page});
    ASSERT_EQ(report.exit_code, 0) << report.err;
    const nlohmann::json told = nlohmann::json::parse(std::ifstream(json)).at("governor");
    EXPECT_EQ(told.at("changes"), 2);
    EXPECT_EQ(told.at("levels").size(), 3U);
    std::ifstream in(page);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    EXPECT_THAT(text, HasSubstr("Levels of quality"));
    EXPECT_THAT(text, HasSubstr("quality-level"));
    EXPECT_THAT(run_gazeloop({"report", session_}).out, HasSubstr("the governor held level 3"));
}

TEST_F(GovernedProgram, KeepsToTheFloor) {
    const ProgramResult ran =
        run({"--record", session_, "--set", "virtual_time.gpu_ms=20", "--set", "governor.floor=1.5",
             "--set", "governor.floor_blink=1.5", "--set", "governor.floor_lost=1.5", "--set",
             "governor.floor_saccade=1.5"});
    ASSERT_EQ(ran.exit_code, 0) << ran.err << ran.out;
    EXPECT_EQ(levels_of(session_).back(), 1);
    EXPECT_THAT(ran.out, HasSubstr("the governor held level 2 of 3"));
}

TEST_F(GovernedProgram, StaysAtTheBestLevelWithRoom) {
    const ProgramResult ran = run({"--record", session_, "--set", "virtual_time.gpu_ms=1"});
    ASSERT_EQ(ran.exit_code, 0) << ran.err << ran.out;
    EXPECT_THAT(ran.out, HasSubstr("in 100.0 % of frames; 0 changes; 100.0 % of frames"));
    EXPECT_EQ(levels_of(session_).back(), 0);
}

TEST_F(GovernedProgram, RunsWithoutOneRecordNoLevel) {
    const ProgramResult ran =
        run_gazeloop({"run", "--gaze", "fixed:3,2", "--target", "headless", "--clock", "virtual",
                      "--frames", "5", "--set", "render.scale=0.04", "--record", session_});
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    for (const auto& level : levels_of(session_)) {
        EXPECT_FALSE(level);
    }
    EXPECT_THAT(run_gazeloop({"report", session_}).out, testing::Not(HasSubstr("governor")));
}

TEST_F(GovernedProgram, RefusesWithPlaceAndRemedy) {
    const auto refused = [&](int code, const std::string& what,
                             const std::vector<std::string>& more) {
        const ProgramResult result = run(more);
        EXPECT_EQ(result.exit_code, code) << result.err;
        EXPECT_THAT(result.err, HasSubstr(what));
    };
    refused(2, "leave one of the two out", {"--method", "full"});
    refused(2, "leave one of the two out", {"--snapshot", folder_.file("pictures")});
    refused(2, "use a higher floor", {"--set", "governor.floor=0.1"});
    refused(2, "did you mean", {"--set", "governor.front=raymrach"});
    const auto with = [&](std::string_view from, std::string_view to) {
        std::string text = kFront;
        text.replace(text.find(from), from.size(), to);
        return folder_.write("bad.toml", text);
    };
    refused(3, "bad.toml:8: kfr", {"--set", "governor.front=" + with("ms = 4", "ms = 40")});
    refused(3, "bad.toml:", {"--set", "governor.front=" + with("loss = 1", "loss = nan")});
    refused(3, "no such setting", {"--set", "governor.front=" + with("kfr.sigma", "acuity.mar")});
    refused(3, "target.name",
            {"--set", "governor.front=" + with("kfr.sigma=1.8", "target.name=x")});
    refused(3, "kfr.sigma", {"--set", "governor.front=" + with("kfr.sigma=1.8", "kfr.sigma=99")});
    refused(3, "nokfr", {"--set", "governor.front=" + with("\"kfr\"", "\"nokfr\"")});
}

TEST(GovernorFront, IsWrittenByATrade) {
    const ScratchFolder folder;
    const std::string front = folder.file("front.toml");
    const ProgramResult traded =
        run_gazeloop({"trade", "--set", "render.scale=0.06", "--methods", "full,kfr,acuity",
                      "--sigma", "1.2,3.2", "--alpha", "4", "--mar", "0.05", "--frames", "1",
                      "--rounds", "1", "--reference-spp", "4", "--front", front});
    ASSERT_EQ(traded.exit_code, 0) << traded.err;
    const ProgramResult ran = run_gazeloop(
        {"run", "--gaze", "fixed:0,0", "--target", "headless", "--clock", "virtual", "--frames",
         "5", "--set", "render.scale=0.04", "--governor", "--set", "governor.front=" + front});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("the governor held level"));
    EXPECT_THAT(run_gazeloop({"trade", "--set", "render.scale=0.06", "--methods", "kfr", "--sigma",
                              "1.2", "--frames", "1", "--rounds", "1", "--reference-spp", "2",
                              "--metric", "psnr", "--front", front})
                    .err,
                HasSubstr("higher is better"));
}

}  // namespace
}  // namespace gazeloop::tests
