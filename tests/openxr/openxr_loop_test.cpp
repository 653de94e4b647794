// The loop through a real OpenXR runtime (the Monado that ./dev setup builds), validation on.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <set>
#include <sstream>

#include "runtime/session/session_file.h"
#include "tests/support/openxr_validation.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

class OpenXrLoop : public testing::Test {
  protected:
    void SetUp() override {
        const ProgramResult made =
            run_gazeloop({"simulate", "gaze", trace(), "--seconds", "30", "--seed", "3"});
        ASSERT_EQ(made.exit_code, 0) << made.err;
    }

    [[nodiscard]] std::string trace() const { return folder_.file("gaze.csv"); }

    /// A run on the runtime with the validation layers of both APIs.
    [[nodiscard]] ProgramResult run(std::vector<std::string> arguments,
                                    ProgramOptions options = {}) const {
        for (const auto& variable : openxr_validation_to(validation_file())) {
            options.environment.push_back(variable);
        }
        for (const char* setting : {"target.name=openxr", "target.validation=true",
                                    "vulkan.validation=true", "render.scale=0.05"}) {
            arguments.insert(arguments.end(), {"--set", setting});
        }
        return run_gazeloop(arguments, options);
    }

    [[nodiscard]] std::string validation_messages(const ProgramResult& result) const {
        EXPECT_NE((result.out + result.err).find(kOpenXrValidationIsOn), std::string::npos)
            << "the validation layer was not loaded: " << result.err;
        return openxr_validation_messages(validation_file());
    }

    [[nodiscard]] std::string validation_file() const {
        return folder_.file("openxr-validation.txt");
    }

    ScratchFolder folder_;
};

TEST_F(OpenXrLoop, RunsRecordsAndReplaysBitForBit) {
    const std::string session = folder_.file("session.gaze");
    const ProgramResult result =
        run({"run", "--gaze", "trace:" + trace(), "--frames", "40", "--hash", "--record", session});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err.find("Vulkan validation"), std::string::npos) << result.err;
    EXPECT_EQ(validation_messages(result), "");
    EXPECT_NE(result.out.find("gaze age at display"), std::string::npos) << result.out;

    const auto recorded = session::read_session(session);
    ASSERT_TRUE(recorded.has_value()) << recorded.error().message;
    EXPECT_EQ(recorded->frames.size(), 40U);
    std::set<std::string> states;
    for (const session::RecordedEvent& event : recorded->events) {
        if (event.kind == "session") {
            states.insert(event.text);
        }
    }
    for (const char* state : {"READY", "SYNCHRONIZED", "FOCUSED", "STOPPING", "EXITING"}) {
        EXPECT_TRUE(states.contains(std::string("session state: ") + state)) << state;
    }
    std::int64_t display_before = 0;
    for (const session::RecordedFrame& frame : recorded->frames) {
        EXPECT_GT(frame.frame.stamps.display.ns, display_before);
        display_before = frame.frame.stamps.display.ns;
    }

    const ProgramResult replayed = run_gazeloop({"replay", session, "--hash"});
    EXPECT_EQ(replayed.exit_code, 0) << replayed.err;
    EXPECT_NE(replayed.out.find("foveae bit-equal in 40 of 40 frames"), std::string::npos)
        << replayed.out;
    EXPECT_EQ(replayed.out.find("not compared"), std::string::npos) << replayed.out;
}

TEST_F(OpenXrLoop, TakesTheDisplaysSizeAndRate) {
    const std::string session = folder_.file("session.gaze");
    const ProgramResult result =
        run({"run", "--display", "generic_2160", "--frames", "5", "--record", session});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto recorded = session::read_session(session);
    ASSERT_TRUE(recorded.has_value());
    ASSERT_FALSE(recorded->frames.empty());
    const frame::FrameRecord& frame = recorded->frames.back().frame;
    EXPECT_EQ(frame.views[0].width_px, 108U);  // 2160 at scale .05
    EXPECT_EQ(frame.views[0].height_px, 108U);
    EXPECT_NEAR(static_cast<double>(frame.period_ns), 1e9 / 90, 1e4);
    EXPECT_NEAR(frame.views[0].fov.left_rad, -52 * 3.14159265 / 180, 1e-5);
    EXPECT_NEAR(frame.views[1].fov.left_rad, -48 * 3.14159265 / 180, 1e-5);
    EXPECT_LT(frame.views[0].pose.position_m.x, frame.views[1].pose.position_m.x);
}

TEST_F(OpenXrLoop, EndsCleanlyWhenInterrupted) {
    const std::string session = folder_.file("session.gaze");
    const ProgramResult result =
        run({"run", "--gaze", "trace:" + trace(), "--record", session, "--log-level", "debug"},
            {.timeout = std::chrono::seconds(90),
             .trigger = "gaze: left eye: tracking",
             .on_trigger = [](int pid) { kill(pid, SIGINT); }});
    EXPECT_EQ(result.exit_code, 130) << result.err;
    EXPECT_EQ(validation_messages(result), "");
    const auto recorded = session::read_session(session);
    ASSERT_TRUE(recorded.has_value()) << recorded.error().message;
    EXPECT_TRUE(recorded->closed_cleanly);
}

// An exit that is asked for before there is a session to ask.
TEST_F(OpenXrLoop, EndsBeforeItHasBegun) {
    // Nothing was rendered.
    EXPECT_EQ(run({"run", "--frames", "0"}, {.timeout = std::chrono::seconds(30)}).exit_code, 1);
    EXPECT_EQ(run({"run"}, {.timeout = std::chrono::seconds(30),
                            .trigger = "Vulkan: ",
                            .on_trigger = [](int pid) { kill(pid, SIGINT); }})
                  .exit_code,
              130);
}

TEST_F(OpenXrLoop, IsASinkForVirtualTime) {
    const std::vector<std::string> words{"replay", trace(), "--frames", "4", "--quiet", "--hash"};
    const ProgramResult first = run(words);
    EXPECT_EQ(first.exit_code, 0) << first.err;
    const ProgramResult second = run(words);
    EXPECT_NE(first.out.find("hash pixels"), std::string::npos) << first.out;
    EXPECT_EQ(first.out, second.out);
}

// A head that moves on its own (the runtime's simulated one) must not move a fixed fovea.
TEST_F(OpenXrLoop, KeepsFixedGazeFixed) {
    const std::string session = folder_.file("session.gaze");
    const ProgramResult result =
        run({"run", "--gaze", "fixed:5,-5", "--frames", "12", "--record", session});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto recorded = session::read_session(session);
    ASSERT_TRUE(recorded.has_value());
    const gaze::FoveaPoint& first = recorded->frames.front().frame.fovea.eyes[0];
    for (const session::RecordedFrame& frame : recorded->frames) {
        EXPECT_NEAR(frame.frame.fovea.eyes[0].position.x_px, first.position.x_px, 1e-6);
        EXPECT_NEAR(frame.frame.fovea.eyes[0].position.y_px, first.position.y_px, 1e-6);
    }
    EXPECT_GT(first.position.x_px, recorded->frames.front().frame.views[0].width_px / 2.0);
    EXPECT_GT(first.position.y_px, recorded->frames.front().frame.views[0].height_px / 2.0);
}

}  // namespace
}  // namespace gazeloop::tests
