#include "runtime/openxr_layer/eye_bindings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace gazeloop::openxr_layer {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

template <typename Handle>
Handle handle(std::uintptr_t number) {
    return reinterpret_cast<Handle>(number);  // NOLINT(performance-no-int-to-ptr)
}

struct TwoSets : testing::Test {
    TwoSets() {
        bindings.add_set(first, 0);
        bindings.add_set(second, 3);
        bindings.add_action(one, first, false);
        bindings.add_action(two, first, true);
        bindings.add_action(three, second, false);
        bindings.suggest(std::array{one, two, three});
    }
    std::vector<XrAction> active(std::initializer_list<SyncedSet> synced) {
        std::vector<XrAction> actions;
        bindings.active(synced, actions);
        return actions;
    }
    XrActionSet first = handle<XrActionSet>(1);
    XrActionSet second = handle<XrActionSet>(2);
    XrAction one = handle<XrAction>(11);
    XrAction two = handle<XrAction>(12);
    XrAction three = handle<XrAction>(13);
    EyeBindings bindings;
};

TEST_F(TwoSets, GiveTheEyesToTheHighestPriority) {
    EXPECT_THAT(active({}), IsEmpty());
    EXPECT_THAT(active({{first}}), ElementsAre(one, two));
    EXPECT_THAT(active({{first}, {second}}), ElementsAre(three));
    EXPECT_THAT(active({{second}, {first}}), ElementsAre(three));
    EXPECT_THAT(active({{first}, {second, false}}), ElementsAre(one, two));
    EXPECT_THAT(active({{first, false}}), IsEmpty()) << "synchronized for a hand";
}

TEST_F(TwoSets, ForgetWhatIsDestroyed) {
    bindings.remove_action(one);
    EXPECT_THAT(active({{first}}), ElementsAre(two));
    EXPECT_FALSE(bindings.is_bound(one));
    bindings.remove_set(second);
    EXPECT_THAT(active({{first}, {second}}), ElementsAre(two));
    EXPECT_FALSE(bindings.is_bound(three));
}

TEST_F(TwoSets, TakeTheLastSuggestion) {
    bindings.suggest(std::array{two});
    EXPECT_THAT(active({{first}, {second}}), ElementsAre(two));
    EXPECT_TRUE(bindings.binds_any(std::array{first}));
    EXPECT_FALSE(bindings.binds_any(std::array{second}));
    EXPECT_TRUE(bindings.declares_eyes(two));
    EXPECT_FALSE(bindings.declares_eyes(one));
    EXPECT_FALSE(bindings.declares_eyes(handle<XrAction>(99)));
}

}  // namespace
}  // namespace gazeloop::openxr_layer
