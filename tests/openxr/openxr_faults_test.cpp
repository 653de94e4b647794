// What an OpenXR runtime can do to the loop, done by a layer above a real one: the program says
// what happened and what to do, with the right code, and nothing recorded until then is lost.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "runtime/session/session_file.h"
#include "tests/support/faults/injected.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

using ::testing::HasSubstr;

struct Fault {
    const char* name;
    const char* plan;
    int exit_code;
    const char* says;    ///< on stderr; empty: nothing needs to be said
    const char* event;   ///< in the recording
    std::size_t frames;  ///< recorded
};

void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }

constexpr std::size_t kFrames = 30;

class OpenXrFault : public testing::TestWithParam<Fault> {
  protected:
    [[nodiscard]] ProgramResult run(const std::string& plan) const {
        return run_gazeloop(
            {"run", "--gaze", "fixed:1,1", "--frames", "30", "--seconds", "500", "--target",
             "openxr", "--set", "render.scale=0.05", "--record", session()},
            {.environment = openxr_faults(plan)});
    }
    [[nodiscard]] std::string session() const { return folder_.file("session.gaze"); }

    ScratchFolder folder_;
};

TEST_P(OpenXrFault, IsSaidAndRecorded) {
    const Fault& fault = GetParam();
    const ProgramResult result = run(fault.plan);
    EXPECT_EQ(result.exit_code, fault.exit_code) << result.err;
    EXPECT_THAT(result.err, HasSubstr(fault.says));
    EXPECT_EQ(result.err.find("error") == std::string::npos, fault.exit_code == 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("gaze age"));

    const auto recorded = session::read_session(session());
    ASSERT_TRUE(recorded.has_value()) << recorded.error().message;
    EXPECT_TRUE(recorded->closed_cleanly);
    EXPECT_EQ(recorded->records_dropped, 0U);
    ASSERT_EQ(recorded->frames.size(), fault.frames);
    for (const session::RecordedFrame& frame : recorded->frames) {
        EXPECT_EQ(frame.gpu.gpu_end.known(), frame.frame.should_render) << frame.frame.index;
    }
    EXPECT_TRUE(std::ranges::any_of(recorded->events, [&](const session::RecordedEvent& event) {
        return event.text.find(fault.event) != std::string::npos;
    })) << fault.event;
    const ProgramResult report = run_gazeloop({"report", session()});
    EXPECT_EQ(report.exit_code, 0) << report.err;
    EXPECT_THAT(report.out, HasSubstr("gaze age"));
    const ProgramResult replay = run_gazeloop({"replay", session()});
    EXPECT_EQ(replay.exit_code, fault.frames > 0 ? 0 : 3) << replay.err;
}

INSTANTIATE_TEST_SUITE_P(
    TheRuntime, OpenXrFault,
    testing::Values(
        Fault{"goes_away", "xrWaitFrame@9=XR_ERROR_INSTANCE_LOST", 5,
              "(xrWaitFrame: XR_ERROR_INSTANCE_LOST): see that the runtime runs",
              "XR_ERROR_INSTANCE_LOST", 8},
        Fault{"loses_the_session", "xrBeginFrame@9=XR_ERROR_SESSION_LOST", 5,
              "(xrBeginFrame: XR_ERROR_SESSION_LOST): see that", "XR_ERROR_SESSION_LOST", 8},
        Fault{"announces_its_end", "xrWaitFrame@9=event:INSTANCE_LOSS_PENDING", 5,
              "instance loss pending", "instance loss pending", 9},
        Fault{"announces_the_sessions_loss", "xrWaitFrame@9=event:LOSS_PENDING", 5,
              "session loss pending", "session state: LOSS_PENDING", 9},
        Fault{"gives_no_image", "xrAcquireSwapchainImage@33=XR_ERROR_CALL_ORDER_INVALID", 5,
              "xrAcquireSwapchainImage", "xrAcquireSwapchainImage", 9},
        Fault{"keeps_an_image", "xrWaitSwapchainImage@33=XR_TIMEOUT_EXPIRED", 5, "it hangs",
              "it hangs", 9},
        Fault{"fails_to_wait_for_an_image", "xrWaitSwapchainImage@34=XR_ERROR_RUNTIME_FAILURE", 5,
              "xrWaitSwapchainImage", "xrWaitSwapchainImage", 9},
        Fault{"takes_no_image_back", "xrReleaseSwapchainImage@34=XR_ERROR_CALL_ORDER_INVALID", 5,
              "xrReleaseSwapchainImage", "xrReleaseSwapchainImage", 9},
        Fault{"refuses_a_frame", "xrEndFrame@9=XR_ERROR_VALIDATION_FAILURE", 5,
              "(xrEndFrame: XR_ERROR_VALIDATION_FAILURE)", "xrEndFrame", 8},
        Fault{"cannot_locate_views", "xrLocateViews@9=XR_ERROR_RUNTIME_FAILURE", 5, "xrLocateViews",
              "xrLocateViews", 8},
        Fault{"cannot_locate_the_head", "xrLocateSpace@9=XR_ERROR_SESSION_LOST", 5, "xrLocateSpace",
              "xrLocateSpace", 8},
        Fault{"fails_to_tell", "xrPollEvent@2=XR_ERROR_RUNTIME_FAILURE", 5, "xrPollEvent",
              "xrPollEvent", 0},
        Fault{"announces_no_time", "xrWaitFrame@9=display=-5", 5, "display time",
              "announced display time is none", 8},
        // What it may do, and the loop goes on.
        Fault{"asks_for_the_end", "xrWaitFrame@9=exit", 0, "ended by the runtime",
              "session state: EXITING", 9},
        Fault{"pauses", "xrWaitFrame@9=pause", 0, "30 frames", "session state: IDLE", kFrames},
        Fault{"never_ends_the_session", "xrRequestExitSession@1=XR_SUCCESS", 0,
              "does not end the session", "it was left", kFrames},
        Fault{"wants_no_pictures", "xrWaitFrame@9+5=hidden", 0, "", "session state: FOCUSED",
              kFrames},
        Fault{"jumps_ahead", "xrWaitFrame@9+5=display+1000000", 0, "", "s ahead", kFrames},
        Fault{"goes_back_in_time", "xrWaitFrame@19+5=display-100", 0, "", "display time went back",
              kFrames},
        Fault{"knows_no_period", "xrWaitFrame@1+10=period=0", 0, "", "session state: FOCUSED",
              kFrames},
        Fault{"has_an_absurd_period", "xrWaitFrame@9+5=period=9223372036854775807", 0, "",
              "session state: FOCUSED", kFrames},
        Fault{"loses_the_head", "xrLocateViews@9+5=untracked;xrLocateSpace@9+5=untracked", 0, "",
              "the head is not tracked", kFrames},
        Fault{"has_no_number_for_the_head", "xrLocateViews@9+5=nan-pose;xrLocateSpace@9+5=nan-pose",
              0, "", "the head is not tracked", kFrames},
        Fault{"turns_the_head_by_nothing", "xrLocateViews@9+5=zero-pose", 0, "",
              "the head is not tracked", kFrames},
        Fault{"never_sees_the_head", "xrLocateViews@1+99=untracked;xrLocateSpace@1+99=untracked", 0,
              "", "the head is not tracked", kFrames},
        Fault{"has_no_number_for_the_view", "xrLocateViews@9+5=nan-fov", 0, "",
              "the last one stands", kFrames},
        Fault{"shows_nothing", "xrLocateViews@9+5=flat-fov", 0, "", "the last one stands", kFrames},
        Fault{"shows_everything", "xrLocateViews@9+5=wide-fov", 0, "", "the last one stands",
              kFrames}),
    [](const auto& instance) { return instance.param.name; });

struct Refusal {
    const char* name;
    const char* plan;
    const char* says;
};

void PrintTo(const Refusal& refusal, std::ostream* out) { *out << refusal.name; }

class OpenXrSetUp : public testing::TestWithParam<Refusal> {};

TEST_P(OpenXrSetUp, FailsWithoutARecording) {
    const ScratchFolder folder;
    const std::string session = folder.file("session.gaze");
    const ProgramResult result = run_gazeloop({"run", "--frames", "3", "--target", "openxr",
                                               "--set", "render.scale=0.05", "--record", session},
                                              {.environment = openxr_faults(GetParam().plan)});
    EXPECT_EQ(result.exit_code, 4) << result.err;
    EXPECT_THAT(result.err, HasSubstr(GetParam().says));
    EXPECT_TRUE(folder.empty());
}

INSTANTIATE_TEST_SUITE_P(
    TheRuntime, OpenXrSetUp,
    testing::Values(Refusal{"makes_no_session", "xrCreateSession@1=XR_ERROR_LIMIT_REACHED",
                            "xrCreateSession: XR_ERROR_LIMIT_REACHED"},
                    Refusal{"wants_a_newer_vulkan", "xrGetVulkanGraphicsRequirements2KHR@1=newer",
                            "wants Vulkan 9.7 or later, gazeloop uses 1.3: use another OpenXR"},
                    Refusal{"makes_one_swapchain_only",
                            "xrCreateSwapchain@2=XR_ERROR_OUT_OF_MEMORY", "use a smaller picture"}),
    [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace gazeloop::tests
