// Clocks that step: the time of day is nobody's business here, and a machine that slept is noted.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <string>

#include "runtime/session/session_file.h"
#include "tests/support/faults/injected.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

constexpr std::int64_t kMinuteNs = 60'000'000'000;

/// A second of recorded frames under clocks that step.
session::SessionFile record(const ScratchFolder& folder, Environment environment) {
    const std::string trace = folder.file("gaze.csv");
    const std::string file = folder.file("session.gaze");
    EXPECT_EQ(run_gazeloop({"simulate", "gaze", trace, "--seconds", "5"}).exit_code, 0);
    const ProgramResult result =
        run_gazeloop({"run", "--gaze", "trace:" + trace, "--target", "headless", "--frames", "60",
                      "--set", "render.scale=0.02", "--record", file},
                     {.environment = std::move(environment)});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return value_or_throw(session::read_session(file));
}

bool slept(const session::SessionFile& session) {
    return std::ranges::any_of(session.events, [](const session::RecordedEvent& event) {
        return event.kind == "clock" && event.text.find("slept for 90.0 s") != std::string::npos;
    });
}

TEST(Clock, OfTheDayMayStep) {
    const ScratchFolder folder;
    const session::SessionFile session = record(folder, stepped_clocks());
    std::tm stated{};
    ASSERT_NE(strptime(session.header.meta.started_utc.c_str(), "%Y-%m-%dT%H:%M:%SZ", &stated),
              nullptr);
    ASSERT_GT(std::abs(std::difftime(timegm(&stated), std::time(nullptr))), 3000.0)
        << "the clock did not step at all";

    ASSERT_EQ(session.frames.size(), 60U);
    EXPECT_EQ(session.records_dropped, 0U);
    EXPECT_FALSE(slept(session));
    const frame::FrameStamps* before = nullptr;
    for (const session::RecordedFrame& frame : session.frames) {
        const frame::FrameStamps& at = frame.frame.stamps;
        EXPECT_LE(at.wake_up.ns, at.latch.ns);
        EXPECT_LE(at.latch.ns, at.submit.ns);
        EXPECT_LT(std::abs(at.display.ns - at.wake_up.ns), kMinuteNs);
        ASSERT_TRUE(frame.gpu.gpu_end.known());
        EXPECT_LT(std::abs(frame.gpu.gpu_end.ns - at.wake_up.ns), kMinuteNs);
        if (before != nullptr) {
            EXPECT_GT(at.wake_up.ns, before->end_frame.ns);
            EXPECT_LT(at.wake_up.ns - before->wake_up.ns, kMinuteNs);
        }
        before = &at;
    }
    EXPECT_EQ(session.frames.back().frame.fovea.eyes[0].state, gaze::FoveaState::Tracking);
}

TEST(Clock, ThatStoodStillWhileTheMachineSleptIsNoted) {
    const ScratchFolder folder;
    Environment environment = stepped_clocks();
    environment.emplace_back("GAZELOOP_SUSPEND_AT", "20");
    const session::SessionFile session = record(folder, environment);
    EXPECT_EQ(session.frames.size(), 60U);
    EXPECT_TRUE(slept(session));
    EXPECT_EQ(std::ranges::count(session.events, "clock", &session::RecordedEvent::kind), 1);
}

}  // namespace
}  // namespace gazeloop::tests
