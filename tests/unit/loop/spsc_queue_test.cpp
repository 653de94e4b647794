#include "runtime/spsc_queue.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <thread>

namespace gazeloop {
namespace {

TEST(SpscQueue, IsEmptyAtFirst) {
    SpscQueue<int> queue(4);
    EXPECT_EQ(queue.front(), nullptr);
    EXPECT_EQ(queue.capacity(), 4U);
}

TEST(SpscQueue, RoundsItsCapacityUp) { EXPECT_EQ(SpscQueue<int>(5).capacity(), 8U); }

TEST(SpscQueue, RefusesWhatDoesNotFit) {
    SpscQueue<int> queue(4);
    for (int i = 0; i < 4; ++i) {
        EXPECT_TRUE(queue.try_push(i));
    }
    EXPECT_FALSE(queue.try_push(4));
    ASSERT_NE(queue.front(), nullptr);
    EXPECT_EQ(*queue.front(), 0);
    queue.pop();
    EXPECT_TRUE(queue.try_push(5));
    for (const int expected : {1, 2, 3, 5}) {
        ASSERT_NE(queue.front(), nullptr);
        EXPECT_EQ(*queue.front(), expected);
        queue.pop();
    }
    EXPECT_EQ(queue.front(), nullptr);
}

TEST(SpscQueue, KeepsOrderAndContentBetweenThreads) {
    struct Item {
        std::uint64_t number = 0;
        std::uint64_t check = 0;
    };
    constexpr std::uint64_t kItems = 300'000;
    SpscQueue<Item> queue(64);
    std::thread producer([&queue] {
        for (std::uint64_t i = 0; i < kItems; ++i) {
            while (!queue.try_push(Item{i, ~i})) {
                std::this_thread::yield();
            }
        }
    });
    std::uint64_t wrong = 0;
    for (std::uint64_t i = 0; i < kItems; ++i) {
        const Item* item = queue.front();
        while (item == nullptr) {
            std::this_thread::yield();
            item = queue.front();
        }
        wrong += item->number != i || item->check != ~i ? 1 : 0;
        queue.pop();
    }
    producer.join();
    EXPECT_EQ(wrong, 0U);
    EXPECT_EQ(queue.front(), nullptr);
}

}  // namespace
}  // namespace gazeloop
