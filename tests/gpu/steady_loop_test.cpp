// The loop in steady state: it asks for no memory, and keeps none.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <string>

#include "runtime/methods/registry.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/watch/watched_call.h"
#include "tests/support/watch/watched_loop.h"

namespace gazeloop::tests {
namespace {

constexpr std::size_t kWarmUp = 60;

void expect_no_allocations(const std::vector<WatchedFrame>& frames) {
    ASSERT_GT(frames.size(), 2 * kWarmUp);
    std::size_t with_gaze = 0;
    for (std::size_t i = kWarmUp; i < frames.size(); ++i) {
        EXPECT_EQ(frames[i].allocations, 0U) << "in frame " << i;
        EXPECT_GT(frames[i].calls, 10U) << "frame " << i << " was not watched";
        with_gaze += frames[i].gaze.vulkan_ns > 0 ? 1 : 0;
    }
    EXPECT_GT(with_gaze, frames.size() / 2);
}

TEST(WatchedThread, CountsItsAllocationsAndLeavesOutThoseInsideCalls) {
    const Spent before = spent_outside_calls();
    const auto first = std::make_unique<int>(1);
    {
        const WatchedCall call;
        const WatchedCall inner;
        const auto second = std::make_unique<int>(2);
    }
    const Spent spent = spent_outside_calls() - before;
    EXPECT_EQ(spent.allocations, 1U);
    EXPECT_EQ(spent.calls, 1U);
    EXPECT_EQ(*first, 1);
}

TEST(SteadyLoop, AllocatesNothingHeadless) {
    for (const std::string& method : methods::rendered_methods()) {
        const TemporaryFolder folder;
        expect_no_allocations(run_watched_loop({.paced = false,
                                                .frames = 400,
                                                .method = method.c_str(),
                                                .record = folder / "session.gaze"}));
    }
}

TEST(SteadyLoop, AllocatesNothingWhilePicturesAreHashed) {
    expect_no_allocations(run_watched_loop({.paced = false, .hash = true, .frames = 200}));
}

TEST(SteadyLoop, AllocatesNothingWhileABudgetIsWatched) {
    const TemporaryFolder folder;
    const std::string lines = folder / "lines.jsonl";
    const int fd = open(lines.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    ASSERT_GE(fd, 0);
    expect_no_allocations(run_watched_loop(
        {.paced = false, .frames = 400, .record = folder / "session.gaze", .monitor_fd = fd}));
    close(fd);
    EXPECT_GT(std::filesystem::file_size(lines), 10'000U);
}

}  // namespace
}  // namespace gazeloop::tests
