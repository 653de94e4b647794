#include "sim/steam_frame_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/support/temporary_folder.h"

namespace gazeloop::sim {
namespace {

using ::testing::HasSubstr;

TEST(SteamFrameFile, SaysThatSomebodyHasCutIt) {
    const tests::TemporaryFolder folder;
    auto file = value_or_throw(SteamFrameFile::create(folder / "service"));
    ASSERT_TRUE(file.publish({}));
    std::filesystem::resize_file(folder / "service", 10);
    const auto published = file.publish({});
    ASSERT_FALSE(published.has_value());
    EXPECT_THAT(published.error().message, HasSubstr("another program has cut it to 10 bytes"));
    EXPECT_EQ(std::filesystem::file_size(folder / "service"), 10U);
}

TEST(SteamFrameFile, RemovesItsOwnAlone) {
    const tests::TemporaryFolder folder;
    {
        const auto file = value_or_throw(SteamFrameFile::create(folder / "service"));
        std::filesystem::remove(folder / "service");
        std::ofstream(folder / "service") << "somebody else's";
    }
    EXPECT_TRUE(std::filesystem::exists(folder / "service"));
    {
        const auto file = value_or_throw(SteamFrameFile::create(folder / "own"));
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "own"));
}

}  // namespace
}  // namespace gazeloop::sim
