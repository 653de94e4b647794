// The loop on a real runtime, in steady state: it asks for no memory between the runtime's calls.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <vector>

#include "runtime/session/session_file.h"
#include "tests/support/faults/injected.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/watch/watched_loop.h"

namespace gazeloop::tests {
namespace {

void expect_no_allocations(const std::vector<WatchedFrame>& frames) {
    ASSERT_EQ(frames.size(), 200U);
    for (std::size_t i = 60; i < frames.size(); ++i) {
        EXPECT_EQ(frames[i].allocations, 0U) << "in frame " << i;
        EXPECT_GT(frames[i].calls, 20U) << "frame " << i << " was not watched";
    }
}

TEST(SteadyOpenXrLoop, AllocatesNothing) {
    const TemporaryFolder folder;
    expect_no_allocations(
        run_watched_loop({.openxr = true, .frames = 200, .record = folder / "session.gaze"}));
}

// With the runtime's own gaze, read at every latch.
TEST(SteadyOpenXrLoop, AllocatesNothingForGaze) {
    const TemporaryFolder folder;
    std::ofstream gaze(folder / "gaze.txt");
    for (int i = 0; i < 12000; ++i) {
        gaze << i / 120.0 << ' ' << 0.2 * std::sin(i / 50.0) << " 0.1 -1\n";
    }
    gaze.close();
    Environment environment = openxr_faults("");
    environment.emplace_back("GAZELOOP_OPENXR_GAZE", folder / "gaze.txt");
    for (const auto& [name, value] : environment) {
        setenv(name.c_str(), value.c_str(), 1);
    }
    const auto frames = run_watched_loop(
        {.openxr = true, .openxr_gaze = true, .frames = 200, .record = folder / "session.gaze"});
    for (const auto& [name, value] : environment) {
        unsetenv(name.c_str());
    }
    expect_no_allocations(frames);
    const session::SessionFile session =
        value_or_throw(session::read_session(folder / "session.gaze"));
    EXPECT_GT(session.samples.size(), 150U);
}

}  // namespace
}  // namespace gazeloop::tests
