#include "runtime/files/unfinished_files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "runtime/files/output_file.h"
#include "tests/support/temporary_folder.h"

namespace gazeloop::files {
namespace {

namespace fs = std::filesystem;

fs::path made(const fs::path& file) {
    std::ofstream(file) << "half";
    return file;
}

TEST(UnfinishedFiles, AreRemovedUntilTheyAreFinished) {
    const tests::TemporaryFolder folder;
    const fs::path kept = made(folder / "kept");
    {
        const UnfinishedFile finished(kept.string());
    }
    const fs::path half = made(folder / "half");
    const UnfinishedFile unfinished(half.string());
    remove_unfinished_files();
    EXPECT_TRUE(fs::exists(kept));
    EXPECT_FALSE(fs::exists(half));
}

TEST(UnfinishedFiles, OfOutputsLeaveWhatWasThere) {
    const tests::TemporaryFolder folder;
    const fs::path file = made(folder / "result");
    auto output = OutputFile::open(file);
    ASSERT_TRUE(output);
    OutputFile moved = std::move(*output);
    ASSERT_TRUE(moved.write("new"));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 2);
    remove_unfinished_files();
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
    EXPECT_EQ(fs::file_size(file), 4U);
}

TEST(UnfinishedFiles, BeyondThoseThatAreRememberedStay) {
    const tests::TemporaryFolder folder;
    std::vector<std::unique_ptr<UnfinishedFile>> many;
    for (std::size_t i = 0; i < UnfinishedFile::kMost + 1; ++i) {
        many.push_back(std::make_unique<UnfinishedFile>(made(folder / std::to_string(i)).string()));
    }
    const UnfinishedFile too_long(std::string(UnfinishedFile::kLongestName, 'n'));
    remove_unfinished_files();
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
    many.clear();
    // And there is room again.
    const fs::path half = made(folder / "half");
    const UnfinishedFile unfinished(half.string());
    remove_unfinished_files();
    EXPECT_FALSE(fs::exists(half));
}

}  // namespace
}  // namespace gazeloop::files
