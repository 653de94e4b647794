// Ten thousand frames take no more memory than five thousand.
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "tests/support/watch/watched_loop.h"

namespace gazeloop::tests {
namespace {

TEST(TenThousandFrames, KeepTheMemoryFlat) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the address sanitizer keeps freed memory to see who uses it still";
#endif
    constexpr std::size_t kFrames = 10'000;
    // By then SQLite's page cache (2 MB) is full.
    constexpr std::size_t kSettled = 5'000;
    // Less than 60 bytes a frame; the recording of one alone has more than 1000.
    constexpr std::size_t kMayGrow = 262'144;
    const TemporaryFolder folder;
    const auto frames = run_watched_loop({.paced = false,
                                          .scale = 0.01,
                                          .frames = kFrames,
                                          .resident_every = 500,
                                          .record = folder / "session.gaze"});
    ASSERT_EQ(frames.size(), kFrames);
    const std::size_t settled = frames[kSettled].resident_bytes;
    const std::size_t end = frames[kFrames - 500].resident_bytes;
    ASSERT_GT(settled, 0U);
    EXPECT_LT(end, settled + kMayGrow);
}

}  // namespace
}  // namespace gazeloop::tests
