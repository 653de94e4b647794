#include "runtime/vulkan/processor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace gazeloop::vulkan {
namespace {

using ::testing::EndsWith;
using ::testing::Not;
using ::testing::StartsWith;

TEST(Processor, NamesItselfWithoutBlanksAround) {
    const std::string name = processor_name();
    EXPECT_THAT(name, Not(StartsWith(" ")));
    EXPECT_THAT(name, Not(EndsWith(" ")));
    EXPECT_EQ(name.find('\0'), std::string::npos);
}

#if defined(__x86_64__)
TEST(Processor, HasAName) { EXPECT_NE(processor_name(), ""); }

// The driver's instruction takes several numbers at once; what is hashed takes one.
TEST(Processor, RoundsOneNumberAsItRoundsFour) {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (std::uint32_t i = 0; i < 8192; i += 4) {
        alignas(16) std::array<float, 4> numbers{};
        for (std::uint32_t k = 0; k < 4; ++k) {
            numbers.at(k) = std::bit_cast<float>(0x3F800000U + (i + k) * 2048U);
        }
        alignas(16) std::array<float, 4> roots{};
        _mm_store_ps(roots.data(), _mm_rsqrt_ps(_mm_load_ps(numbers.data())));
        for (std::uint32_t k = 0; k < 4; ++k) {
            // What the makers promise of their tables.
            ASSERT_NEAR(roots.at(k) * std::sqrt(numbers.at(k)), 1.0, 1.5 / 4096.0);
            hash = (hash ^ std::bit_cast<std::uint32_t>(roots.at(k))) * 0x100000001b3;
        }
    }
    EXPECT_EQ(inverse_square_root_hash(), hash);
}
#endif

}  // namespace
}  // namespace gazeloop::vulkan
