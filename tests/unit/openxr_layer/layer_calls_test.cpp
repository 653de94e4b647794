// The layer above a mock runtime: calls in any order that an application may make them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "runtime/openxr_layer/permissions.h"
#include "runtime/openxr_layer/private_file.h"
#include "runtime/session/session_file.h"
#include "runtime/time/clock.h"
#include "tests/support/allocation_counter.h"
#include "tests/unit/openxr_layer/any_call.h"
#include "tests/unit/openxr_layer/gaze_reader.h"
#include "tests/unit/openxr_layer/mock_application.h"
#include "tests/unit/openxr_layer/mock_home.h"
#include "tests/unit/openxr_layer/mock_runtime.h"

namespace gazeloop::openxr_layer {
namespace {

constexpr XrSpaceLocationFlags kAll = 0xF;

/// Times that the log says something.
std::size_t times_said(const Home& home, std::string_view text) {
    const std::string log = home.log();
    std::size_t times = 0;
    for (std::size_t at = log.find(text); at != std::string::npos; at = log.find(text, at + 1)) {
        ++times;
    }
    return times;
}

TEST(LayerCalls, GiveGazeThatTheRuntimeHasNeverHeardOf) {
    const Home home;
    set_settings("layer.gaze=fixed:0,0");
    MockApplication application;
    make_gaze_reader(application);
    EXPECT_TRUE(application.active(application.actions[0]));
    EXPECT_TRUE(application.active(application.actions[0], application.path("/user/eyes_ext")));
    EXPECT_FALSE(MockRuntime::the().saw_eyes());
    XrResult result = XR_SUCCESS;
    const XrTime now = MockRuntime::now();
    EXPECT_EQ(
        application.locate(application.spaces[0], application.spaces[1], now, result).locationFlags,
        kAll);
    // Without focus nothing is active, and the gaze is nowhere.
    MockRuntime::the().set_focused(false);
    EXPECT_EQ(application.sync(), XR_SESSION_NOT_FOCUSED);
    EXPECT_FALSE(application.active(application.actions[0]));
    MockRuntime::the().set_focused(true);
    EXPECT_EQ(application.sync(), XR_SUCCESS);
    EXPECT_TRUE(application.active(application.actions[0]));
    // A session that is lost: the error is the runtime's, and nothing is active.
    MockRuntime::the().fail_next("xrSyncActions", XR_ERROR_SESSION_LOST);
    EXPECT_EQ(application.sync(), XR_ERROR_SESSION_LOST);
    EXPECT_FALSE(application.active(application.actions[0]));
    MockRuntime::the().fail_next("xrLocateSpace", XR_ERROR_SESSION_LOST);
    EXPECT_EQ(application.sync(), XR_SUCCESS);
    MockRuntime::the().fail_next("xrLocateSpace", XR_ERROR_SESSION_LOST);
    application.locate(application.spaces[0], application.spaces[1], now, result);
    EXPECT_EQ(result, XR_ERROR_SESSION_LOST);
}

/// What the layer has enabled for itself is not the application's.
TEST(LayerCalls, HideTheExtensionThatIsForTheLayer) {
    const Home home;
    set_settings("layer.gaze=fixed:0,0");
    constexpr const char* kConvert = "xrConvertTimeToTimespecTimeKHR";
    {
        const MockApplication application;
        EXPECT_EQ(application.call<PFN_xrVoidFunction>(kConvert), nullptr);
    }
    const MockApplication application({XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME});
    EXPECT_NE(application.call<PFN_xrVoidFunction>(kConvert), nullptr);
}

TEST(LayerCalls, KeepTwoInstancesApart) {
    const Home home;
    set_settings("layer.gaze=fixed:0,0");
    MockApplication one;
    make_gaze_reader(one);
    XrInstance other = XR_NULL_HANDLE;
    ASSERT_EQ(MockRuntime::the().create_through_layer({}, other), XR_SUCCESS);
    ASSERT_NE(other, one.instance);
    // It has not asked for gaze: nothing but its end is the layer's.
    const auto sync = MockRuntime::through_layer<PFN_xrSyncActions>(other, "xrSyncActions");
    EXPECT_NE(sync, one.call<PFN_xrSyncActions>("xrSyncActions"));
    EXPECT_TRUE(one.active(one.actions[0]));
    MockRuntime::through_layer<PFN_xrDestroyInstance>(other, "xrDestroyInstance")(other);
}

/// Both read gaze of one source and are to be recorded to one file. The end of one is nothing to
/// the other.
TEST(LayerCalls, GiveGazeToTwoInstances) {
    const Home home;
    const std::string file = home.folder.path() / "session.gaze";
    set_settings("layer.gaze=fixed:0,0\nlayer.record=" + file);
    MockApplication one;
    make_gaze_reader(one);
    const auto reads = [](const MockApplication& application) {
        XrResult result = XR_SUCCESS;
        const XrSpaceLocation location = application.locate(
            application.spaces[0], application.spaces[1], MockRuntime::now(), result);
        return result == XR_SUCCESS && location.locationFlags == kAll;
    };
    {
        MockApplication two;
        make_gaze_reader(two);
        for (int frame = 0; frame < 5; ++frame) {
            one.frame(one.spaces[2]);
            two.frame(two.spaces[2]);
            EXPECT_TRUE(reads(two));
            EXPECT_TRUE(reads(one));
        }
        EXPECT_TRUE(two.active(two.actions[0]));
    }
    EXPECT_TRUE(one.active(one.actions[0]));
    EXPECT_EQ(one.sync(), XR_SUCCESS);
    EXPECT_TRUE(reads(one));
    one.frame(one.spaces[2]);
    one.call<PFN_xrDestroySession>("xrDestroySession")(one.session);
    EXPECT_EQ(value_or_throw(session::read_session(file)).frames.size(), 6U);
    EXPECT_EQ(times_said(home, "nothing is recorded"), 1U) << home.log();
}

/// Of a runtime that has the core of 1.0 alone, the times are the host's once a frame has shown it.
TEST(LayerCalls, GiveGazeAboveTheOldestRuntime) {
    const Home home;
    set_settings("layer.gaze=fixed:0,0");
    MockRuntime::the().set_oldest(true);
    {
        MockApplication application;
        make_gaze_reader(application);
        application.frame(application.spaces[2]);
        ASSERT_EQ(application.sync(), XR_SUCCESS);
        EXPECT_TRUE(application.active(application.actions[0]));
        XrResult result = XR_SUCCESS;
        EXPECT_EQ(
            application
                .locate(application.spaces[0], application.spaces[1], MockRuntime::now(), result)
                .locationFlags,
            kAll);
        EXPECT_EQ(result, XR_SUCCESS);
        EXPECT_EQ(application.call<newer::LocateSpaces>("xrLocateSpaces"), nullptr);
        EXPECT_FALSE(MockRuntime::the().saw_eyes());
    }
    MockRuntime::the().set_oldest(false);
}

/// An application of panels alone, which asks for no views and reads gaze, is measured as others.
TEST(LayerCalls, RecordFramesOfPanelsAlone) {
    const Home home;
    const std::string file = home.folder.path() / "panels.gaze";
    set_settings("layer.gaze=fixed:3,4\nlayer.record=" + file);
    {
        MockApplication application;
        make_gaze_reader(application);
        for (int frame = 0; frame < 10; ++frame) {
            application.frame_of_panels([&](XrTime display) {
                application.sync();
                XrResult result = XR_SUCCESS;
                application.locate(application.spaces[0], application.spaces[1], display, result);
            });
        }
        application.call<PFN_xrDestroySession>("xrDestroySession")(application.session);
    }
    const session::SessionFile session = value_or_throw(session::read_session(file));
    ASSERT_EQ(session.frames.size(), 10U);
    for (const session::RecordedFrame& recorded : session.frames) {
        const frame::FrameRecord& frame = recorded.frame;
        EXPECT_TRUE(frame.should_render);
        EXPECT_EQ(frame.views[0].width_px, 1600U);
        EXPECT_EQ(frame.samples.pixels_output, 0U) << "no picture of the views was drawn";
        EXPECT_LE(frame.stamps.latch.ns, frame.stamps.submit.ns);
    }
    EXPECT_EQ(session.frames.back().frame.fovea.eyes[0].state, gaze::FoveaState::Tracking);
}

TEST(LayerCalls, TellOfEachSessionThatReadsGaze) {
    const Home home;
    set_settings("layer.gaze=fixed:0,0");
    MockApplication application;
    for (std::size_t session = 1; session <= 3; ++session) {
        make_gaze_reader(application);
        EXPECT_EQ(times_said(home, "reads gaze of fixed:0,0"), session - 1);
        XrResult result = XR_SUCCESS;
        for (int read = 0; read < 5; ++read) {
            ASSERT_NE(application
                          .locate(application.spaces[0], application.spaces[1], MockRuntime::now(),
                                  result)
                          .locationFlags,
                      0U);
        }
        EXPECT_EQ(times_said(home, "reads gaze of fixed:0,0"), session);
        application.call<PFN_xrDestroySession>("xrDestroySession")(application.session);
        EXPECT_EQ(times_said(home, "has read gaze 5 times"), session);
        application.forget();
    }
}

/// Whatever the application still calls, and though it never synchronizes its actions again.
TEST(LayerCalls, GiveNoGazeOnceItIsDenied) {
    const Home home;
    set_settings("layer.gaze=fixed:0,0");
    MockApplication application;
    make_gaze_reader(application);
    const auto gets_gaze = [&application] {
        auto sample = openxr::typed<XrEyeGazeSampleTimeEXT>(XR_TYPE_EYE_GAZE_SAMPLE_TIME_EXT);
        auto location = openxr::typed<XrSpaceLocation>(XR_TYPE_SPACE_LOCATION);
        location.next = &sample;
        application.call<PFN_xrLocateSpace>("xrLocateSpace")(
            application.spaces[0], application.spaces[1], MockRuntime::now(), &location);
        return sample.time != 0;
    };
    ASSERT_TRUE(gets_gaze());
    Permissions permissions;
    permissions.set(std::filesystem::read_symlink("/proc/self/exe"), Permissions::Answer::Denied);
    ASSERT_TRUE(write_private(Permissions::file().value(), permissions.text()));
    // A second, as is said, and what a busy machine adds.
    constexpr std::int64_t kPatience_ns = 20'000'000'000;
    const std::int64_t until_ns = time::monotonic_ns() + kPatience_ns;
    while (gets_gaze() && time::monotonic_ns() < until_ns) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_FALSE(gets_gaze());
    EXPECT_GT(times_said(home, "gets no gaze"), 0U);
}

/// A program that exits with all it has made, while a thread of it is in the layer.
TEST(LayerCalls, LetAProgramExitWithoutDestroyingAnything) {
    const Home home;
    const std::string file = home.folder.path() / "session.gaze";
    set_settings("layer.gaze=sim\nlayer.record=" + file);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        auto& application = *new MockApplication;
        make_gaze_reader(application);
        for (int frame = 0; frame < 20; ++frame) {
            application.frame(application.spaces[2]);
        }
        std::exit(0);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 0);
    const session::SessionFile session = value_or_throw(session::read_session(file));
    EXPECT_EQ(session.frames.size(), 20U);
    EXPECT_EQ(session.records_dropped, 0U);
}

/// It ends as a program does, with none of the threads that it was forked beside.
TEST(LayerCalls, LetAForkOfAProgramExit) {
    const Home home;
    const std::string file = home.folder.path() / "session.gaze";
    set_settings("layer.gaze=sim\nlayer.record=" + file);
    MockApplication application;
    make_gaze_reader(application);
    application.frame(application.spaces[2]);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        constexpr unsigned kPatience_s = 20;
        alarm(kPatience_s);
        std::exit(0);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status)) << "it hangs";
    application.frame(application.spaces[2]);
    application.call<PFN_xrDestroySession>("xrDestroySession")(application.session);
    EXPECT_EQ(value_or_throw(session::read_session(file)).frames.size(), 2U);
}

TEST(LayerCalls, AllocateNothingInSteadyState) {
    const Home home;
    const std::string session = home.folder.path() / "session.gaze";
    set_settings("layer.gaze=fixed:3,4\nlayer.record=" + session);
    MockApplication application;
    make_gaze_reader(application);
    std::size_t before = 0;
    std::vector<std::int64_t> own_ns;
    own_ns.reserve(600);
    for (int frame = 0; frame < 600; ++frame) {
        if (frame == 100) {
            before = tests::allocations_of_this_thread();
        }
        const std::int64_t start_ns = time::monotonic_ns();
        application.sync();
        XrResult result = XR_SUCCESS;
        application.frame(application.spaces[2]);
        application.locate(application.spaces[0], application.spaces[2], MockRuntime::now(),
                           result);
        own_ns.push_back(time::monotonic_ns() - start_ns);
    }
    EXPECT_EQ(tests::allocations_of_this_thread() - before, 0U);
    std::ranges::sort(own_ns);
    RecordProperty("frame_p50_ns", std::to_string(own_ns[300]));
    RecordProperty("frame_p99_ns", std::to_string(own_ns[594]));
}

RC_GTEST_PROP(LayerCalls, ComeInAnyOrder, ()) {
    const Home home;
    set_settings(*rc::gen::element<std::string>(
        "layer.gaze=fixed:1,2", "layer.gaze=sim", "", "layer.gaze=fixed:0,0\nlayer.eye_gaze=always",
        "layer.gaze=fixed:0,0\nlayer.unknown_applications=deny",
        "layer.gaze=sim\nlayer.record=" + home.folder.path().string()));
    MockApplication application(every_extension());
    application.make_session();
    const int calls = *rc::gen::inRange(0, 150);
    for (int call = 0; call < calls; ++call) {
        any_call(application,
                 [](std::size_t many) { return *rc::gen::inRange<std::size_t>(0, many); });
    }
    RC_ASSERT(!MockRuntime::the().saw_eyes());
}

}  // namespace
}  // namespace gazeloop::openxr_layer
