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

std::vector<std::uint32_t> fetched(ResidentViews& views, const List& likely, std::uint32_t most) {
    List loads;
    for (const ResidentViews::Load& load : views.fetch_ahead(likely, most)) {
        EXPECT_EQ(views.layer_of(load.view), load.layer);
        loads.push_back(load.view);
    }
    return loads;
}

TEST(ResidentViews, AreFetchedAheadInFreeLayersAndTheOldest) {
    ResidentViews views(9, 4);
    (void)loaded(views, {0, 1});
    (void)loaded(views, {2});
    EXPECT_EQ(fetched(views, {2, 5, 6, 7}, 9), (List{5, 6, 7})) << "0 and 1 were asked for before";
    EXPECT_TRUE(views.is_resident(2)) << "it is asked for now";
    (void)loaded(views, {2});
    EXPECT_EQ(fetched(views, {8}, 9), List{8}) << "not likely any more: one of them goes";
    (void)loaded(views, {2});
    EXPECT_EQ(fetched(views, {4, 3, 1}, 2), (List{4, 3})) << "as many as may be";
    EXPECT_TRUE(views.is_resident(2));
}

TEST(ResidentViews, ThatAreLikelierStay) {
    ResidentViews views(9, 3);
    (void)loaded(views, {0});
    EXPECT_EQ(fetched(views, {1, 2, 3, 4}, 9), (List{1, 2})) << "there is no room for 3 and 4";
    (void)loaded(views, {0});
    EXPECT_EQ(fetched(views, {1, 2, 3, 4}, 9), List{}) << "and none is fetched again and again";
    (void)loaded(views, {0});
    EXPECT_EQ(fetched(views, {1, 5, 2}, 9), List{5});
    EXPECT_EQ(views.fetched(), 3U);
    EXPECT_EQ(views.fetched_and_wanted(), 0U);
    EXPECT_FALSE(views.is_resident(2)) << "the least likely went";
    EXPECT_EQ(loaded(views, {5, 1}), List{});
    EXPECT_EQ(views.fetched_and_wanted(), 2U);
}

// A view that went again before it was asked for was fetched for nothing; one that was asked for
// counts once.
TEST(ResidentViews, ThatWereFetchedCountOnceWhenAskedFor) {
    ResidentViews views(9, 2);
    (void)loaded(views, {0});
    EXPECT_EQ(fetched(views, {1}, 9), List{1});
    EXPECT_EQ(loaded(views, {1}), List{});
    (void)loaded(views, {1});
    EXPECT_EQ(views.fetched_and_wanted(), 1U);
    EXPECT_EQ(fetched(views, {2}, 9), List{2});
    EXPECT_EQ(loaded(views, {3, 4}), (List{3, 4}));
    EXPECT_EQ(loaded(views, {2}), List{2});
    EXPECT_EQ(views.fetched(), 2U);
    EXPECT_EQ(views.fetched_and_wanted(), 1U);
}

// However much is fetched ahead: what a frame asks for is there, each in a layer of its own, and
// stays while others come.
TEST(ResidentViews, OfTheLastRequestStayWhateverIsFetched) {
    std::mt19937 random(11);
    constexpr std::uint32_t kViews = 40;
    for (const std::uint32_t layers : {5U, 12U, 39U}) {
        ResidentViews views(kViews, layers);
        const auto some = [&](std::size_t most) {
            std::set<std::uint32_t> chosen;
            const std::size_t count = 1 + random() % most;
            while (chosen.size() < count) {
                chosen.insert(static_cast<std::uint32_t>(random() % kViews));
            }
            List list(chosen.begin(), chosen.end());
            std::ranges::shuffle(list, random);
            return list;
        };
        for (int request = 0; request < 400; ++request) {
            const List wanted = some(layers);
            (void)loaded(views, wanted);
            const List layers_before = [&] {
                List of;
                for (const std::uint32_t view : wanted) {
                    of.push_back(views.layer_of(view));
                }
                return of;
            }();
            const std::uint32_t most = static_cast<std::uint32_t>(random() % 6);
            ASSERT_LE(fetched(views, some(20), most).size(), most);
            std::set<std::uint32_t> in_layers;
            for (std::uint32_t view = 0; view < kViews; ++view) {
                if (views.is_resident(view)) {
                    ASSERT_TRUE(in_layers.insert(views.layer_of(view)).second);
                }
            }
            for (std::size_t i = 0; i < wanted.size(); ++i) {
                ASSERT_TRUE(views.is_resident(wanted[i]));
                ASSERT_EQ(views.layer_of(wanted[i]), layers_before[i]);
            }
        }
        EXPECT_LE(views.fetched_and_wanted(), views.fetched());
        EXPECT_GT(views.fetched_and_wanted(), 0U);
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
