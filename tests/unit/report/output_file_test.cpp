#include "runtime/report/output_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>

#include "tests/support/temporary_folder.h"

namespace gazeloop::report {
namespace {

using ::testing::HasSubstr;

class CheckApart : public ::testing::Test {
  protected:
    [[nodiscard]] static Expected<void> check(const std::filesystem::path& output,
                                              const std::filesystem::path& other,
                                              const std::filesystem::path& input) {
        const std::array<NamedFile, 2> outputs{{{"--csv", output}, {"--json", other}}};
        const std::array<NamedFile, 1> inputs{{{"the session", input}}};
        return check_apart(outputs, inputs);
    }
    tests::TemporaryFolder folder;
};

TEST_F(CheckApart, TakesFilesOfTheirOwnAndNone) {
    EXPECT_TRUE(check(folder / "a", folder / "b", folder / "c").has_value());
    EXPECT_TRUE(check("", "", "").has_value());
    EXPECT_TRUE(check("-", folder / "b", "-").has_value()) << "stdin is not stdout";
}

TEST_F(CheckApart, RefusesTwoOutputsInOneFile) {
    const auto same = check(folder / "a", folder / "." / "a", folder / "c");
    ASSERT_FALSE(same.has_value());
    EXPECT_EQ(same.error().kind, ErrorKind::Usage);
    EXPECT_THAT(same.error().message, HasSubstr("--csv and --json both name "));
    EXPECT_FALSE(check("-", "-", "").has_value());
}

TEST_F(CheckApart, RefusesToWriteOverWhatIsReadByAnyName) {
    std::ofstream(folder / "session") << "gaze";
    std::filesystem::create_symlink(folder / "session", folder / "link");
    std::filesystem::create_hard_link(folder / "session", folder / "twin");
    for (const char* name : {"session", "link", "twin"}) {
        const auto lost = check("", folder / name, folder / "session");
        ASSERT_FALSE(lost.has_value()) << name;
        EXPECT_EQ(lost.error().kind, ErrorKind::Usage);
        EXPECT_THAT(lost.error().message, HasSubstr("which is read (the session)"));
    }
}

TEST_F(CheckApart, RefusesToWriteOverWhatLiesInAFolderThatIsRead) {
    std::filesystem::create_directory(folder / "frames");
    std::ofstream(folder / "frames" / "1.png") << "a frame";
    const auto lost = check(folder / "frames" / "1.png", "", folder / "frames");
    ASSERT_FALSE(lost.has_value());
    EXPECT_EQ(lost.error().kind, ErrorKind::Usage);
    EXPECT_TRUE(check(folder / "frames" / "new.json", "", folder / "frames").has_value());
}

}  // namespace
}  // namespace gazeloop::report
