// What is too much for memory, in a file without a name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "runtime/files/scratch_file.h"
#include "tests/support/temporary_folder.h"

namespace gazeloop::files {
namespace {

TEST(ScratchFile, GivesBackWhatWasWrittenAndLeavesNothing) {
    const tests::TemporaryFolder folder;
    auto file = ScratchFile::create(1 << 20, folder.path());
    ASSERT_TRUE(file.has_value()) << file.error().message;
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
    const auto nowhere = ScratchFile::create(10, folder / "none");
    ASSERT_FALSE(nowhere.has_value());
    EXPECT_EQ(nowhere.error().kind, ErrorKind::BadInput);
    EXPECT_THAT(nowhere.error().message,
                testing::AllOf(testing::HasSubstr("none: a scratch file cannot be made"),
                               testing::HasSubstr("TMPDIR")));
    const auto endless = ScratchFile::create(std::uint64_t{1} << 60U, folder.path());
    ASSERT_FALSE(endless.has_value());
    EXPECT_THAT(endless.error().message, testing::HasSubstr("of 1099511627777 MiB finds no room"));
}

}  // namespace
}  // namespace gazeloop::files
