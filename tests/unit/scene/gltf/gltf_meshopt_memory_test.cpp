#include <gtest/gtest.h>

#include "runtime/scene/gltf/meshopt_memory.h"

namespace gazeloop::scene::gltf {
namespace {

TEST(GltfMeshoptMemory, HoldsForACallWhatTheOneBeforeAskedFor) {
    MeshoptMemory memory;
    const int elsewhere = 0;
    EXPECT_EQ(memory.take(1000), nullptr) << "nobody has asked before";
    EXPECT_EQ(memory.take(500), nullptr);
    EXPECT_FALSE(memory.give_back(&elsewhere));
    EXPECT_FALSE(memory.give_back(&elsewhere));

    void* const first = memory.take(1000);
    void* const second = memory.take(500);
    ASSERT_NE(first, nullptr);
    ASSERT_NE(second, nullptr);
    EXPECT_GE(static_cast<std::byte*>(second) - static_cast<std::byte*>(first), 1000);
    EXPECT_TRUE(memory.give_back(second));
    EXPECT_EQ(memory.take(500), second) << "as a stack";
    EXPECT_TRUE(memory.give_back(second));
    EXPECT_TRUE(memory.give_back(first));
    EXPECT_EQ(memory.take(500), first) << "of the same memory";
    EXPECT_TRUE(memory.give_back(first));
}

TEST(GltfMeshoptMemory, DoesNotKeepWhatOneLargeShapeNeeds) {
    MeshoptMemory memory;
    constexpr std::size_t kLarge = std::size_t{1} << 30U;
    const int elsewhere = 0;
    for (int call = 0; call < 2; ++call) {
        EXPECT_EQ(memory.take(kLarge), nullptr);
        EXPECT_FALSE(memory.give_back(&elsewhere));
    }
    EXPECT_EQ(memory.take(~std::size_t{0}), nullptr) << "as for a number that overflowed";
    EXPECT_FALSE(memory.give_back(&elsewhere));
}

}  // namespace
}  // namespace gazeloop::scene::gltf
