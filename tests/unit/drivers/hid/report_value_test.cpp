#include "drivers/hid/report_value.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <vector>

namespace gazeloop::drivers::hid {
namespace {

TEST(ReportValue, ReadsSignedAndUnsignedNumbers) {
    const std::vector<std::uint8_t> bytes{0xFE, 0xFF, 0xFF, 0x7F, 0xFF, 0xFF, 0xFF, 0xFF};
    const auto raw = [&](std::uint32_t offset, std::uint32_t bits, bool is_signed) {
        return ReportValue{.bit_offset = offset, .bits = bits, .is_signed = is_signed}.raw(bytes);
    };
    EXPECT_EQ(raw(0, 8, true), -2);
    EXPECT_EQ(raw(0, 8, false), 254);
    EXPECT_EQ(raw(0, 32, true), 0x7FFFFFFE);
    EXPECT_EQ(raw(4, 4, true), -1);
    EXPECT_EQ(raw(0, 1, false), 0);
    EXPECT_EQ(raw(0, 64, true), static_cast<std::int64_t>(0xFFFFFFFF7FFFFFFE));
    EXPECT_FALSE(raw(0, 64, false).has_value()) << "above the greatest signed number";
    EXPECT_FALSE(raw(57, 8, false).has_value());
    EXPECT_FALSE(raw(std::numeric_limits<std::uint32_t>::max(), 8, false).has_value());
}

TEST(ReportValue, KnowsNoData) {
    const auto number = [](std::uint64_t value, std::uint32_t bits, bool is_signed) {
        std::vector<std::uint8_t> bytes(8);
        write_bits(bytes, 0, bits, value);
        return ReportValue{.bits = bits, .is_signed = is_signed}.number(bytes).has_value();
    };
    EXPECT_FALSE(number(0xFF, 8, false));
    EXPECT_TRUE(number(0x7F, 8, false));
    EXPECT_FALSE(number(0x7F, 8, true));
    EXPECT_FALSE(number(0xFFFF'FFFF, 32, false));
    EXPECT_FALSE(number(0x7FFF'FFFF, 32, false)) << "INT32_MAX, whatever the field's sign";
    EXPECT_FALSE(number(0x7FFF'FFFF, 32, true));
    EXPECT_TRUE(number(0x7FFF'FFFE, 32, false));
    EXPECT_TRUE(number(0x7FFF'FFFF, 64, false));
    EXPECT_TRUE(number(0x7FFF, 16, false));
}

RC_GTEST_PROP(ReportValue, WhatIsWrittenIsRead, (const std::vector<std::uint8_t>& before)) {
    const auto size = static_cast<std::uint32_t>(8 * before.size());
    RC_PRE(size > 0U);
    const auto bits = *rc::gen::inRange<std::uint32_t>(1, std::min(size, 64U) + 1);
    const auto offset = *rc::gen::inRange<std::uint32_t>(0, size - bits + 1);
    const auto value = *rc::gen::arbitrary<std::uint64_t>();
    std::vector<std::uint8_t> bytes = before;
    RC_ASSERT(write_bits(bytes, offset, bits, value));
    const std::uint64_t mask = bits == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
    RC_ASSERT(read_bits(bytes, offset, bits) == (value & mask));
    // The neighbours are untouched.
    if (offset > 0) {
        RC_ASSERT(read_bits(bytes, offset - 1, 1) == read_bits(before, offset - 1, 1));
    }
    if (offset + bits < size) {
        RC_ASSERT(read_bits(bytes, offset + bits, 1) == read_bits(before, offset + bits, 1));
    }
    RC_ASSERT(!write_bits(bytes, size - bits + 1, bits, value));
    RC_ASSERT(!read_bits(bytes, size - bits + 1, bits));
}

}  // namespace
}  // namespace gazeloop::drivers::hid
