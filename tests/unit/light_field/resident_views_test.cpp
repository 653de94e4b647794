// Which views are in memory: what is asked for is, and what was asked for longest ago goes.
#include <gtest/gtest.h>

#include <algorithm>
#include <list>
#include <random>
#include <set>
#include <vector>

#include "runtime/light_field/resident_views.h"

namespace gazeloop::light_field {
namespace {

std::vector<std::uint32_t> loaded(ResidentViews& views, const std::vector<std::uint32_t>& wanted) {
    std::vector<std::uint32_t> loads;
    for (const ResidentViews::Load& load : views.request(wanted)) {
        EXPECT_EQ(views.layer_of(load.view), load.layer);
        loads.push_back(load.view);
    }
    return loads;
}

using List = std::vector<std::uint32_t>;

TEST(ResidentViews, ComeInOnceAndInTheOrderOfTheRequest) {
    ResidentViews views(9, 4);
    EXPECT_EQ(loaded(views, {5, 2, 5}), (List{5, 2}));
    EXPECT_EQ(loaded(views, {2, 5}), List{});
    EXPECT_EQ(loaded(views, {7, 2, 0}), (List{7, 0}));
    EXPECT_TRUE(views.is_resident(5));
}

TEST(ResidentViews, GoWhenTheyWereAskedForLongestAgo) {
    ResidentViews views(9, 3);
    (void)loaded(views, {0});
    (void)loaded(views, {1});
    (void)loaded(views, {2});
    (void)loaded(views, {0});
    EXPECT_EQ(loaded(views, {3}), List{3});
    EXPECT_FALSE(views.is_resident(1));
    EXPECT_TRUE(views.is_resident(0));
    // None takes the layer of another one that the same frame needs.
    EXPECT_EQ(loaded(views, {8, 0, 3}), List{8});
    EXPECT_FALSE(views.is_resident(2));
}

// Against a list in the order of use, over random requests of every size that may be.
TEST(ResidentViews, AreThoseOfAListInTheOrderOfUse) {
    std::mt19937 random(7);
    for (const std::uint32_t layers : {1U, 5U, 12U, 40U}) {
        constexpr std::uint32_t kViews = 40;
        ResidentViews views(kViews, layers);
        std::list<std::set<std::uint32_t>> used;  // the last request first
        for (int request = 0; request < 400; ++request) {
            std::set<std::uint32_t> wanted;
            const std::size_t count = 1 + random() % layers;
            while (wanted.size() < count) {
                wanted.insert(static_cast<std::uint32_t>(random() % kViews));
            }
            const auto loads = loaded(views, {wanted.begin(), wanted.end()});
            std::set<std::uint32_t> resident;
            std::set<std::uint32_t> in_layers;
            for (std::uint32_t view = 0; view < kViews; ++view) {
                if (views.is_resident(view)) {
                    resident.insert(view);
                    ASSERT_LT(views.layer_of(view), layers);
                    ASSERT_TRUE(in_layers.insert(views.layer_of(view)).second);
                }
            }
            ASSERT_TRUE(std::ranges::includes(resident, wanted));
            ASSERT_LE(loads.size(), wanted.size());
            for (auto& earlier : used) {
                for (const std::uint32_t view : wanted) {
                    earlier.erase(view);
                }
            }
            used.push_front(wanted);
            // Whoever stayed was used no earlier than whoever left.
            bool left = false;
            for (const auto& at_once : used) {
                const bool all = std::ranges::includes(resident, at_once);
                ASSERT_TRUE(!left || std::ranges::none_of(at_once, [&](std::uint32_t view) {
                    return resident.contains(view);
                }));
                left = left || !all;
            }
        }
    }
}

// A replay asks for the same and loads the same.
TEST(ResidentViews, FollowFromTheRequestsAlone) {
    const auto run = [] {
        std::mt19937 random(3);
        ResidentViews views(25, 6);
        List all;
        for (int request = 0; request < 100; ++request) {
            const List wanted{static_cast<std::uint32_t>(random() % 25),
                              static_cast<std::uint32_t>(random() % 25)};
            for (const ResidentViews::Load& load : views.request(wanted)) {
                all.push_back(load.view);
                all.push_back(load.layer);
            }
        }
        return all;
    };
    EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace gazeloop::light_field
