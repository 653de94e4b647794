// What an OpenXR runtime can do to the loop, done by a layer above a real one: the program says
// what happened and what to do, with the right code, and nothing recorded until then is lost.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "runtime/session/session_file.h"
#include "tests/support/faults/injected.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

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
        // What it may do, and the loop goes on.
        Fault{"asks_for_the_end", "xrWaitFrame@9=exit", 0, "ended by the runtime",
              "session state: EXITING", 9},
        // Monado says STOPPING for each request.
        Fault{"is_asked_for_the_end_twice", "xrWaitFrame@30=exit", 0, "30 frames",
              "session state: EXITING", kFrames},
        Fault{"stops_the_session_twice", "xrWaitFrame@9=exit;xrEndSession@1=again", 0,
              "ended by the runtime", "session state: EXITING", 9},
        Fault{"announces_no_time", "xrWaitFrame@9=display=-5", 0,
              "display-time-odd: the announced display time is none (-5)",
              "display times are good again, 1 were not", kFrames},
        Fault{"announces_no_time_at_first", "xrWaitFrame@1+5=display=0", 0, "time is none (0)",
              "good again, 5 were not", kFrames},
        Fault{"announces_the_end_of_time", "xrWaitFrame@9+5=display=9223372036854775807", 0,
              "the announced display time", "good again, 5 were not", kFrames},
        Fault{"announces_the_beginning_of_time", "xrWaitFrame@9+5=display=1", 0,
              "the announced display time", "good again, 5 were not", kFrames},
        Fault{"pauses", "xrWaitFrame@9=pause", 0, "30 frames", "session state: IDLE", kFrames},
        Fault{"never_ends_the_session", "xrRequestExitSession@1=XR_SUCCESS", 0,
              "does not end the session", "it was left", kFrames},
        Fault{"wants_no_pictures", "xrWaitFrame@9+5=hidden", 0, "", "session state: FOCUSED",
              kFrames},
        Fault{"jumps_ahead", "xrWaitFrame@9+5=display+1000000", 0, "s ahead", "s ahead", kFrames},
        Fault{"goes_back_in_time", "xrWaitFrame@19+5=display-100", 0, "display time went back",
              "display time went back", kFrames},
        Fault{"knows_no_period", "xrWaitFrame@1+10=period=0", 0, "", "session state: FOCUSED",
              kFrames},
        Fault{"has_an_absurd_period", "xrWaitFrame@9+5=period=9223372036854775807", 0,
              "period-odd: the announced display period", "which no display has", kFrames},
        Fault{"loses_the_head", "xrLocateViews@9+5=untracked;xrLocateSpace@9+5=untracked", 0,
              "head-lost: the head is not tracked", "the head is not tracked", kFrames},
        Fault{"has_no_number_for_the_head", "xrLocateViews@9+5=nan-pose;xrLocateSpace@9+5=nan-pose",
              0, "", "the head is not tracked", kFrames},
        Fault{"turns_the_head_by_nothing", "xrLocateViews@9+5=zero-pose", 0, "",
              "the head is not tracked", kFrames},
        Fault{"never_sees_the_head", "xrLocateViews@1+99=untracked;xrLocateSpace@1+99=untracked", 0,
              "", "the head is not tracked", kFrames},
        Fault{"has_no_number_for_the_view", "xrLocateViews@9+5=nan-fov", 0, "view-odd: a field",
              "the last one stands", kFrames},
        Fault{"shows_nothing", "xrLocateViews@9+5=flat-fov", 0, "", "the last one stands", kFrames},
        Fault{"shows_everything", "xrLocateViews@9+5=wide-fov", 0, "", "the last one stands",
              kFrames}),
    [](const auto& instance) { return instance.param.name; });

/// Runs of 60 frames on a runtime whose announced times are absurd for a while.
class OpenXrTimes : public testing::Test {
  protected:
    ProgramResult run(const std::string& plan, const std::vector<std::string>& more = {}) {
        std::vector<std::string> words{
            "run",      "--gaze", "fixed:1,1", "--frames",          "60",
            "--target", "openxr", "--set",     "render.scale=0.05", "--record",
            session(),  "--json", json()};
        words.insert(words.end(), more.begin(), more.end());
        return run_gazeloop(words, {.environment = openxr_faults(plan)});
    }
    [[nodiscard]] std::string session() const { return folder_.file("session.gaze"); }
    [[nodiscard]] std::string json() const { return folder_.file("run.json"); }
    [[nodiscard]] static nlohmann::json read(const std::string& file) {
        std::ifstream stream(file);
        return nlohmann::json::parse(stream);
    }
    static std::size_t times(const std::string& text, const std::string& part) {
        std::size_t count = 0;
        for (std::size_t at = text.find(part); at != std::string::npos;
             at = text.find(part, at + 1)) {
            ++count;
        }
        return count;
    }

    ScratchFolder folder_;
};

TEST_F(OpenXrTimes, DaysAheadAreUnknownSaidOnceAndCounted) {
    const ProgramResult result = run("xrWaitFrame@10+30=display+2384640000");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(times(result.err, "the announced display time lies 23846"), 1U) << result.err;
    EXPECT_THAT(result.out, HasSubstr("at an unknown time in 30 of "));
    EXPECT_THAT(result.out, HasSubstr("what happened, from the first frame on\n"
                                      "- display-time-odd at "));
    const nlohmann::json summary = read(json());
    EXPECT_EQ(summary["frames"]["display_unknown"], 30);
    EXPECT_EQ(summary["durations"]["gaze_age_at_display"]["frames"],
              summary["frames"]["rendered"].get<int>() - 30);
    EXPECT_LT(summary["durations"]["gaze_age_at_display"]["max_ms"], 10'000.0);
    EXPECT_EQ(summary["happenings"][0]["kind"], "display-time-odd");
    EXPECT_EQ(summary["happenings"][0]["times"], 1);

    // The recording says the same, played or run again.
    const std::string report_json = folder_.file("report.json");
    const ProgramResult report = run_gazeloop({"report", session(), "--json", report_json});
    EXPECT_EQ(report.exit_code, 0) << report.err;
    const nlohmann::json reported = read(report_json);
    for (const char* const same : {"frames", "happenings", "samples", "gaze"}) {
        EXPECT_EQ(reported[same], summary[same]) << same;
    }
    EXPECT_THAT(report.out, HasSubstr("at an unknown time in 30 of "));
    EXPECT_THAT(report.out, HasSubstr("- display-time-odd at "));
    const ProgramResult replay = run_gazeloop({"replay", session()});
    EXPECT_EQ(replay.exit_code, 0) << replay.err;
    EXPECT_THAT(replay.out, HasSubstr("- display-time-odd at "));
}

TEST_F(OpenXrTimes, NoneForAWhileIsSurvived) {
    const ProgramResult result = run("xrWaitFrame@15+5=display=0");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(times(result.err, "the announced display time is none (0)"), 1U) << result.err;
    EXPECT_EQ(read(json())["frames"]["display_unknown"], 5);
    EXPECT_EQ(read(json())["frames"]["total"], 60);
}

TEST_F(OpenXrTimes, NoneForLongEndsTheSessionAndKeepsTheRecording) {
    const ProgramResult result =
        run("xrWaitFrame@15+100000=display=0", {"--set", "openxr.patience_s=0.3"});
    EXPECT_EQ(result.exit_code, 5) << result.err;
    EXPECT_THAT(result.err, HasSubstr("openxr.patience_s = 0.3"));
    const auto recorded = value_or_throw(session::read_session(session()));
    EXPECT_TRUE(recorded.closed_cleanly);
    EXPECT_GE(recorded.frames.size(), 15U) << "some were survived";
    EXPECT_FALSE(recorded.frames.back().frame.stamps.display.known());
}

TEST_F(OpenXrTimes, WithoutPatienceTheFirstEndsTheSession) {
    const ProgramResult result = run("xrWaitFrame@15=display=0", {"--set", "openxr.patience_s=0"});
    EXPECT_EQ(result.exit_code, 5) << result.err;
    EXPECT_EQ(value_or_throw(session::read_session(session())).frames.size(), 14U);
}

TEST_F(OpenXrTimes, PatienceHasARange) {
    const ProgramResult result = run("", {"--set", "openxr.patience_s=-1"});
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_THAT(result.err, HasSubstr("must lie in [0, 3600]"));
}

TEST_F(OpenXrTimes, FlappingOnesAreCountedAndDoNotFlood) {
    std::string plan;
    for (int call = 10; call < 50; call += 2) {
        plan += (plan.empty() ? "" : ";") + ("xrWaitFrame@" + std::to_string(call)) + "=display=0";
    }
    const ProgramResult result = run(plan);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_LE(times(result.err, "display-time-odd"), 6U) << result.err;
    EXPECT_EQ(read(json())["happenings"][0]["times"], 20);
}

// The profile's display has switching times, and goes on having them.
TEST_F(OpenXrTimes, OddPeriodsDecideNothing) {
    ASSERT_EQ(run("").exit_code, 0);
    const nlohmann::json without = read(json());
    std::filesystem::remove(session());
    ASSERT_EQ(run("xrWaitFrame@9+3=period=3000000;xrWaitFrame@60=period=3000000").exit_code, 0);
    const nlohmann::json with = read(json());
    EXPECT_NEAR(with["display_period_ns"].get<double>(), without["display_period_ns"].get<double>(),
                1e5);
    for (const char* figure : {"switching_ns", "rolling_ns"}) {
        EXPECT_TRUE(without[figure].is_number()) << figure;
        EXPECT_EQ(with[figure], without[figure]) << figure;
    }
}

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

struct Named {
    const char* name;
    Environment environment;
    const char* says;
    std::vector<std::string> more{};
};

void PrintTo(const Named& named, std::ostream* out) { *out << named.name; }

class OpenXrEnvironment : public testing::TestWithParam<Named> {};

// What has two possible causes names the one that holds.
TEST_P(OpenXrEnvironment, IsNamedWhereItIsToBlame) {
    std::vector<std::string> words{"run", "--frames", "1", "--set", "render.scale=0.05"};
    words.insert(words.end(), GetParam().more.begin(), GetParam().more.end());
    const ProgramResult result = run_gazeloop(words, {.environment = GetParam().environment});
    EXPECT_EQ(result.exit_code, 4) << result.err;
    EXPECT_THAT(result.err, HasSubstr(GetParam().says));
    if (GetParam().more.empty()) {
        EXPECT_THAT(result.err, Not(HasSubstr("validation"))) << "which is off";
    }
}

INSTANTIATE_TEST_SUITE_P(
    TheRuntime, OpenXrEnvironment,
    testing::Values(
        Named{"absent_layer",
              {{"XR_ENABLE_API_LAYERS", "XR_APILAYER_nobody"}},
              "XR_ENABLE_API_LAYERS='XR_APILAYER_nobody' names the layer XR_APILAYER_nobody, which "
              "no manifest in the usual folders has"},
        Named{"absent_layer_folder",
              {{"XR_ENABLE_API_LAYERS", "XR_APILAYER_nobody"}, {"XR_API_LAYER_PATH", "/nowhere"}},
              "XR_API_LAYER_PATH='/nowhere', which stands for all the usual folders ('/nowhere' is "
              "no folder)"},
        Named{"validation_layer_elsewhere",
              {{"XR_API_LAYER_PATH", "/nowhere"}},
              "target.validation is on, but no manifest in XR_API_LAYER_PATH='/nowhere'",
              {"--set", "target.validation=true"}},
        Named{"no_vulkan_driver",
              {{"VK_ICD_FILENAMES", "/nowhere/icd.json"}, {"VK_DRIVER_FILES", ""}},
              "VK_ICD_FILENAMES names '/nowhere/icd.json', which does not exist: correct or unset "
              "VK_ICD_FILENAMES"},
        Named{"no_vulkan_driver_by_the_newer_name",
              {{"VK_ICD_FILENAMES", ""}, {"VK_DRIVER_FILES", "/nowhere/icd.json"}},
              "VK_DRIVER_FILES names '/nowhere/icd.json', which does not exist"},
        Named{"all_vulkan_drivers_left_out",
              {{"VK_LOADER_DRIVERS_DISABLE", "*"}},
              "VK_LOADER_DRIVERS_DISABLE='*' leaves drivers out"}),
    [](const auto& instance) { return instance.param.name; });

TEST(OpenXrManifest, SaysWhatIsWrongWithIt) {
    const ScratchFolder folder;
    for (const auto& [text, says] :
         {std::pair{"", "is no JSON"},
          {"{\"runtime\": 3}", "has no runtime.library_path"},
          {R"({"file_format_version": "1.0.0", "runtime": {"library_path": "./no.so"}})",
           "./no.so', which cannot be loaded"}}) {
        const std::string manifest = folder.write("runtime.json", text);
        const ProgramResult result = run_gazeloop({"run", "--frames", "1"},
                                                  {.environment = {{"XR_RUNTIME_JSON", manifest}}});
        EXPECT_EQ(result.exit_code, 4) << result.err;
        EXPECT_THAT(result.err, HasSubstr("XR_RUNTIME_JSON='" + manifest + "'"));
        EXPECT_THAT(result.err, HasSubstr(says));
    }
}

}  // namespace
}  // namespace gazeloop::tests
