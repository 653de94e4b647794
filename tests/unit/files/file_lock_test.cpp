#include "runtime/files/file_lock.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <fstream>

#include "tests/support/temporary_folder.h"

namespace gazeloop::files {
namespace {

using ::testing::HasSubstr;

class FileLockTest : public testing::Test {
  protected:
    tests::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_.path() / "one.lock";
};

TEST_F(FileLockTest, IsTakenOnceAndLeavesNothing) {
    {
        auto held = FileLock::take(file_, "writes it");
        ASSERT_TRUE(held) << held.error().message;
        const auto second = FileLock::take(file_, "writes it");
        ASSERT_FALSE(second);
        EXPECT_EQ(second.error().kind, ErrorKind::BadInput);
        EXPECT_EQ(second.error().message,
                  file_.string() + ": another program writes it: wait until it ends");
        const FileLock moved = std::move(*held);
        EXPECT_FALSE(FileLock::take(file_, "writes it"));
    }
    EXPECT_FALSE(std::filesystem::exists(file_));
    EXPECT_TRUE(FileLock::take(file_, "writes it"));
}

TEST_F(FileLockTest, OfAKilledProgramIsTakenOver) {
    std::array<int, 2> ready{};
    ASSERT_EQ(pipe(ready.data()), 0);
    const pid_t child = fork();
    if (child == 0) {
        const auto held = FileLock::take(file_, "writes it");
        const char told = held ? '1' : '0';
        _exit(write(ready[1], &told, 1) == 1 ? pause() : 1);
    }
    char told = 0;
    ASSERT_EQ(read(ready[0], &told, 1), 1);
    ASSERT_EQ(told, '1');
    EXPECT_FALSE(FileLock::take(file_, "writes it"));
    ASSERT_EQ(kill(child, SIGKILL), 0);
    ASSERT_EQ(waitpid(child, nullptr, 0), child);
    EXPECT_TRUE(std::filesystem::exists(file_));
    EXPECT_TRUE(FileLock::take(file_, "writes it"));
    close(ready[0]);
    close(ready[1]);
}

TEST_F(FileLockTest, FollowsNoLinkAndNamesWhatCannotBeMade) {
    std::ofstream(folder_.path() / "other") << "kept";
    std::filesystem::create_symlink(folder_.path() / "other", file_);
    EXPECT_THAT(FileLock::take(file_, "writes it").error().message, HasSubstr("cannot be made"));
    EXPECT_THAT(FileLock::take(folder_.path() / "no" / "one", "writes it").error().message,
                HasSubstr("cannot be made"));
    EXPECT_EQ(std::filesystem::file_size(folder_.path() / "other"), 4U);
}

}  // namespace
}  // namespace gazeloop::files
