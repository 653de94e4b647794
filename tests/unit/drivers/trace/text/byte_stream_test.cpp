#include "drivers/trace/text/byte_stream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <sstream>
#include <string>

#include "tests/support/gzip.h"

namespace gazeloop::drivers {
namespace {

using ::testing::HasSubstr;
using tests::gzipped;

/// All of it, read in pieces; or the error.
std::string read_all(const std::string& file, std::size_t piece = 1000) {
    std::istringstream in(file);
    ByteStream bytes(in);
    std::string all;
    std::string part(piece, '\0');
    while (true) {
        const auto read = bytes.read(part);
        if (!read) {
            return "error: " + read.error();
        }
        if (*read == 0) {
            return all;
        }
        all.append(part, 0, *read);
    }
}

/// Text that does not compress to nothing.
std::string long_text(std::size_t size) {
    std::string text;
    std::uint32_t state = 1;
    while (text.size() < size) {
        state = state * 1664525U + 1013904223U;
        text += static_cast<char>('0' + (state >> 24) % 10);
    }
    return text;
}

TEST(ByteStream, GivesAFileAsItIs) {
    const std::string text = long_text(200'000);
    EXPECT_EQ(read_all(text), text);
    EXPECT_EQ(read_all(text, 1), text);
    EXPECT_EQ(read_all(""), "");
    EXPECT_EQ(read_all("\x1f"), "\x1f");
}

TEST(ByteStream, KnowsWhatIsLeftOfAFileButNotOfGzip) {
    const std::string text = long_text(200'000);
    std::istringstream in(text);
    ByteStream bytes(in);
    std::string part(1000, '\0');
    ASSERT_EQ(bytes.read(part), 1000U);
    EXPECT_EQ(bytes.bytes_left(), 199'000U);
    ASSERT_EQ(bytes.read(part), 1000U);
    EXPECT_EQ(part, text.substr(1000, 1000)) << "it reads on where it was";
    EXPECT_EQ(bytes.bytes_left(), 198'000U);

    std::istringstream compressed(gzipped(text));
    ByteStream unknown(compressed);
    ASSERT_GT(unknown.read(part).value(), 0U);
    EXPECT_FALSE(unknown.bytes_left().has_value());
}

TEST(ByteStream, DecompressesGzip) {
    const std::string text = long_text(500'000);
    const std::string file = gzipped(text);
    ASSERT_GT(file.size(), 2U * 65'536U) << "else no piece of it ends within";
    EXPECT_EQ(read_all(file), text);
    EXPECT_EQ(read_all(file, 100'000), text);
    EXPECT_EQ(read_all(gzipped("")), "");
    std::istringstream in(file);
    ByteStream bytes(in);
    std::string part(10, '\0');
    ASSERT_TRUE(bytes.read(part));
    EXPECT_TRUE(bytes.is_gzip());
}

TEST(ByteStream, DecompressesSeveralMembers) {
    const std::string text = long_text(150'000);
    EXPECT_EQ(read_all(gzipped(text) + gzipped("") + gzipped("end")), text + "end");
}

TEST(ByteStream, SaysThatGzipWasCut) {
    const std::string file = gzipped(long_text(500'000));
    for (const std::size_t left :
         {std::size_t{2}, std::size_t{9}, file.size() / 2, file.size() - 9, file.size() - 1}) {
        EXPECT_THAT(read_all(file.substr(0, left)), HasSubstr("the file was cut: copy or")) << left;
    }
    EXPECT_THAT(read_all(file + file.substr(0, 5)), HasSubstr("the file was cut"));
}

TEST(ByteStream, SaysWhatFollowsGzip) {
    EXPECT_THAT(read_all(gzipped("a") + "1;2;3\n"), HasSubstr("something else follows the end"));
    EXPECT_THAT(read_all(gzipped("a") + std::string(512, '\0')), HasSubstr("something else"));
}

TEST(ByteStream, SaysThatGzipIsDamaged) {
    std::string file = gzipped(long_text(1000));
    std::string wrong_sum = file;
    wrong_sum[file.size() - 8] ^= 1;
    EXPECT_THAT(read_all(wrong_sum), HasSubstr("the gzip data are damaged (incorrect data check)"));
    file[2] = 7;
    EXPECT_THAT(read_all(file), HasSubstr("damaged (unknown compression method)"));
}

}  // namespace
}  // namespace gazeloop::drivers
