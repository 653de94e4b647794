// The loop on a real runtime, in steady state: it asks for no memory between the runtime's calls.
#include <gtest/gtest.h>

#include <vector>

#include "runtime/session/session_file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/watch/played_gaze.h"
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

// With the runtime's own gaze, read at every latch, split by the depth that was read back.
TEST(SteadyOpenXrLoop, AllocatesNothingForGaze) {
    const TemporaryFolder folder;
    {
        const PlayedGaze gaze;
        expect_no_allocations(run_watched_loop({.openxr = true,
                                                .openxr_gaze = true,
                                                .frames = 200,
                                                .record = folder / "session.gaze"}));
    }
    const session::SessionFile session =
        value_or_throw(session::read_session(folder / "session.gaze"));
    EXPECT_GT(session.samples.size(), 150U);
}

}  // namespace
}  // namespace gazeloop::tests
