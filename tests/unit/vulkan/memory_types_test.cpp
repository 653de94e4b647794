#include "runtime/vulkan/memory_types.h"

#include <gtest/gtest.h>

namespace gazeloop::vulkan {
namespace {

using Property = vk::MemoryPropertyFlagBits;

/// As discrete GPUs list them: system memory first, then their own.
vk::PhysicalDeviceMemoryProperties discrete() {
    vk::PhysicalDeviceMemoryProperties properties;
    properties.memoryTypeCount = 4;
    properties.memoryTypes[0].propertyFlags = Property::eHostVisible | Property::eHostCoherent;
    properties.memoryTypes[1].propertyFlags =
        Property::eHostVisible | Property::eHostCoherent | Property::eHostCached;
    properties.memoryTypes[2].propertyFlags = Property::eDeviceLocal;
    properties.memoryTypes[3].propertyFlags =
        Property::eDeviceLocal | Property::eHostVisible | Property::eHostCoherent;
    return properties;
}

// What every fragment reads must not lie behind the bus.
TEST(MemoryTypes, TablesLieInTheDevicesOwnMemory) {
    EXPECT_EQ(choose_memory_type(discrete(), ~0U, MemoryFor::Device), 2U);
    EXPECT_EQ(choose_memory_type(discrete(), 0b1011U, MemoryFor::Device), 3U);
}

TEST(MemoryTypes, WhatTheHostWritesOrReadsIsVisibleToIt) {
    EXPECT_EQ(choose_memory_type(discrete(), ~0U, MemoryFor::Upload), 0U);
    EXPECT_EQ(choose_memory_type(discrete(), ~0U, MemoryFor::ReadBack), 1U);
    EXPECT_EQ(choose_memory_type(discrete(), 0b1101U, MemoryFor::ReadBack), 0U);
}

TEST(MemoryTypes, AreNoneWhereTheMaskLeavesNone) {
    EXPECT_EQ(choose_memory_type(discrete(), 0b0011U, MemoryFor::Device), std::nullopt);
    EXPECT_EQ(choose_memory_type({}, ~0U, MemoryFor::Upload), std::nullopt);
}

}  // namespace
}  // namespace gazeloop::vulkan
