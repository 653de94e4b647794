#include "runtime/memory/large_pages.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <new>
#include <string>
#include <vector>

namespace gazeloop::memory {
namespace {

/// Whether the mapping of an address bears the advice: "hg" among its flags (proc(5)).
bool is_advised(const void* address) {
    std::ifstream maps("/proc/self/smaps");
    const auto wanted = std::bit_cast<std::uintptr_t>(address);
    bool is_in = false;
    for (std::string line; std::getline(maps, line);) {
        if (const std::size_t dash = line.find('-');
            dash != std::string::npos && dash == line.find_first_not_of("0123456789abcdef")) {
            is_in = std::stoull(line, nullptr, 16) <= wanted &&
                    wanted < std::stoull(line.substr(dash + 1), nullptr, 16);
        } else if (is_in && line.starts_with("VmFlags:")) {
            return line.find(" hg") != std::string::npos;
        }
    }
    return false;
}

class LargePagesTest : public testing::Test {
  protected:
    void SetUp() override {
        if (!std::ifstream("/sys/kernel/mm/transparent_hugepage/enabled")) {
            GTEST_SKIP() << "this kernel has no large pages";
        }
    }
};

TEST_F(LargePagesTest, HoldLongVectorsAndNoShortOnes) {
    LargePagesVector<std::byte> pages(2 * kLargePage, std::byte{7});
    EXPECT_EQ(std::bit_cast<std::uintptr_t>(pages.data()) % kLargePage, 0U);
    EXPECT_TRUE(is_advised(pages.data()));
    EXPECT_TRUE(is_advised(&pages.back()));
    pages.push_back(std::byte{8});
    EXPECT_EQ(pages.front(), std::byte{7});
    pages.resize(1);
    pages.shrink_to_fit();
    EXPECT_EQ(pages.capacity(), 1U);
    EXPECT_EQ(pages.front(), std::byte{7});
}

TEST_F(LargePagesTest, HoldTheRoomOfAnyVector) {
    std::vector<int> numbers;
    reserve_in_large_pages(numbers, 2 * kLargePage);
    EXPECT_GE(numbers.capacity(), 2 * kLargePage);
    EXPECT_TRUE(is_advised(numbers.data() + kLargePage));
    const int* const before = numbers.data();
    reserve_in_large_pages(numbers, 3);
    EXPECT_EQ(numbers.data(), before);
}

TEST_F(LargePagesTest, RefuseWhatNoAddressReaches) {
    LargePagesAllocator<int> allocator;
    EXPECT_THROW((void)allocator.allocate(~std::size_t{0} / 2), std::bad_array_new_length);
}

}  // namespace
}  // namespace gazeloop::memory
