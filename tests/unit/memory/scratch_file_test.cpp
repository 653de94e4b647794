// What is too much for memory, in a file without a name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "runtime/memory/scratch_file.h"
#include "tests/support/temporary_folder.h"

namespace gazeloop::memory {
namespace {

TEST(ScratchFile, GivesBackWhatWasWrittenAndLeavesNothing) {
    const tests::TemporaryFolder folder;
    auto file = ScratchFile::make(folder.path());
    ASSERT_TRUE(file.has_value()) << file.error().message;
    ASSERT_TRUE(file->reserve(1 << 20).has_value());
    EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << "it has no name";
    const std::vector<std::byte> written(1000, std::byte{42});
    ASSERT_TRUE(file->write(5000, written).has_value());
    ScratchFile moved = *std::move(file);
    std::vector<std::byte> read(1002);
    ASSERT_TRUE(moved.read(4999, read).has_value());
    EXPECT_EQ(read.front(), std::byte{0});
    EXPECT_EQ(read.back(), std::byte{0});
    EXPECT_TRUE(std::equal(written.begin(), written.end(), read.begin() + 1));
    EXPECT_FALSE(moved.read((1 << 20) - 1, read).has_value()) << "beyond its end";
}

TEST(ScratchFile, SaysWhereThereIsNoRoomForIt) {
    const tests::TemporaryFolder folder;
    const auto nowhere = ScratchFile::make(folder / "none");
    ASSERT_FALSE(nowhere.has_value());
    EXPECT_EQ(nowhere.error().kind, ErrorKind::BadInput);
    EXPECT_THAT(nowhere.error().message, testing::AllOf(testing::HasSubstr("none: no scratch file"),
                                                        testing::HasSubstr("TMPDIR")));
    const auto endless = ScratchFile::make(folder.path()).value().reserve(std::size_t{1} << 60U);
    ASSERT_FALSE(endless.has_value());
    EXPECT_THAT(endless.error().message,
                testing::HasSubstr("no room for a scratch file of 1099511627777 MiB"));
}

}  // namespace
}  // namespace gazeloop::memory
