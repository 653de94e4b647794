#include "runtime/vulkan/processor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

TEST(Processor, HasOneTableOfInverseSquareRoots) {
    EXPECT_EQ(inverse_square_root_hash(), inverse_square_root_hash());
#if defined(__x86_64__)
    EXPECT_NE(inverse_square_root_hash(), 0U);
    EXPECT_NE(processor_name(), "");
#endif
}

}  // namespace
}  // namespace gazeloop::vulkan
