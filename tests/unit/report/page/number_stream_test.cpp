#include "runtime/report/page/number_stream.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace gazeloop::report::page {
namespace {

/// What page/numbers.js does, in whole numbers.
std::vector<std::optional<std::int64_t>> read(std::string_view bytes) {
    std::vector<std::optional<std::int64_t>> numbers;
    std::int64_t before = 0;
    while (!bytes.empty()) {
        std::uint64_t code = 0;
        unsigned shift = 0;
        std::uint8_t group = 0;
        do {
            group = static_cast<std::uint8_t>(bytes.front());
            bytes.remove_prefix(1);
            code |= static_cast<std::uint64_t>(group & 0x7fU) << shift;
            shift += 7;
        } while (group > 0x7f);
        if (code == 0) {
            numbers.emplace_back();
            continue;
        }
        const std::uint64_t zigzag = code - 1;
        before += static_cast<std::int64_t>(zigzag >> 1U) ^ -static_cast<std::int64_t>(zigzag & 1U);
        numbers.emplace_back(before);
    }
    return numbers;
}

TEST(NumberStream, ReadsBackWhatWasAdded) {
    constexpr std::int64_t kMost = std::int64_t{1} << 53U;
    const std::vector<std::optional<std::int64_t>> numbers{
        0, 1, -1, std::nullopt, -1, 63, 64, 200'000, std::nullopt, kMost, -kMost, kMost, 0};
    NumberStream stream;
    stream.begin_series();
    for (const auto& number : numbers) {
        stream.add(number);
    }
    EXPECT_EQ(read(stream.bytes()), numbers);
}

TEST(NumberStream, TakesOneByteForWhatHardlyChanges) {
    NumberStream stream;
    for (std::int64_t i = 0; i < 100; ++i) {
        stream.add(i * 3);
    }
    EXPECT_EQ(stream.bytes().size(), 100U);
}

TEST(NumberStream, PacksAsBase64OfZlib) {
    EXPECT_EQ(packed("").size() % 4, 0U);
    std::string bytes;
    for (int i = 0; i < 1000; ++i) {
        bytes += static_cast<char>(i * i);
    }
    const std::string text = packed(bytes);
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string raw;
    ASSERT_EQ(text.size() % 4, 0U);
    for (std::size_t at = 0; at < text.size(); at += 4) {
        std::uint32_t bits = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            const std::size_t digit = kDigits.find(text[at + i]);
            bits = bits << 6U | static_cast<std::uint32_t>(digit == std::string::npos ? 0 : digit);
        }
        for (const unsigned shift : {16U, 8U, 0U}) {
            raw += static_cast<char>(bits >> shift & 0xffU);
        }
    }
    std::string back(bytes.size(), '\0');
    uLongf size = back.size();
    // NOLINTBEGIN(cppcoreguidelines-pro-type-reinterpret-cast): zlib's bytes are unsigned
    ASSERT_EQ(uncompress(reinterpret_cast<Bytef*>(back.data()), &size,
                         reinterpret_cast<const Bytef*>(raw.data()), raw.size()),
              Z_OK);
    // NOLINTEND(cppcoreguidelines-pro-type-reinterpret-cast)
    EXPECT_EQ(back, bytes);
}

}  // namespace
}  // namespace gazeloop::report::page
