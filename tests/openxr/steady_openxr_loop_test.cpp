// The loop on a real runtime, in steady state: it asks for no memory between the runtime's calls.
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "tests/support/watch/watched_loop.h"

namespace gazeloop::tests {
namespace {

TEST(SteadyOpenXrLoop, AllocatesNothing) {
    const TemporaryFolder folder;
    const auto frames =
        run_watched_loop({.openxr = true, .frames = 200, .record = folder / "session.gaze"});
    ASSERT_EQ(frames.size(), 200U);
    for (std::size_t i = 60; i < frames.size(); ++i) {
        EXPECT_EQ(frames[i].allocations, 0U) << "in frame " << i;
        EXPECT_GT(frames[i].calls, 20U) << "frame " << i << " was not watched";
    }
}

}  // namespace
}  // namespace gazeloop::tests
