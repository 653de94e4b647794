#include "runtime/frame/passes.h"

#include <gtest/gtest.h>

#include "runtime/frame/frame_record.h"

namespace gazeloop::frame {
namespace {

// A pass that did not run is unknown, whichever it is: never 0 ms.
TEST(PassTimes, AreUnknownUntilAPassRan) {
    FrameGpuRecord record;
    for (std::size_t pass = 0; pass < kMostPasses; ++pass) {
        EXPECT_EQ(record.passes[pass], std::nullopt) << pass;
    }
    record.passes.set(kMostPasses - 1, 0);
    EXPECT_EQ(record.passes[kMostPasses - 1], 0);
    record.passes.set(kMostPasses - 1, std::nullopt);
    EXPECT_EQ(record.passes[kMostPasses - 1], std::nullopt);
}

TEST(NameList, IsKeptAsText) {
    const NameList list{"pass_i", "disc", "resolve"};
    const auto again = NameList::parse(list.text(), 3);
    ASSERT_TRUE(again.has_value());
    EXPECT_EQ(*again, list);
    EXPECT_EQ(list.find("resolve"), 2U);
    EXPECT_EQ(list.find("full"), std::nullopt);
    EXPECT_EQ(NameList::parse("", 3)->size(), 0U);
}

TEST(NameList, RefusesWhatIsNoListOfNames) {
    for (const char* const text : {" ", "a ", " a", "a  b", "A", "a;b", "a a", "a b c d", "\xff"}) {
        EXPECT_FALSE(NameList::parse(text, 3).has_value()) << text;
    }
}

}  // namespace
}  // namespace gazeloop::frame
