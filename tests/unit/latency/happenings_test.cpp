#include "runtime/latency/happenings.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "tests/support/allocation_counter.h"

namespace gazeloop::latency {
namespace {

time::Stamp at(std::int64_t ns) { return {ns, time::StampKind::Measured}; }

TEST(Happenings, AreOneThingWhereTextsDifferInNumbersAlone) {
    EXPECT_TRUE(same_but_for_numbers("", ""));
    EXPECT_TRUE(same_but_for_numbers("back by 3.1 ms", "back by 12.75 ms"));
    EXPECT_TRUE(same_but_for_numbers("none (0): x", "none (-5): x"));
    EXPECT_FALSE(same_but_for_numbers("3.1 s ahead", "3.1 s back"));
    EXPECT_FALSE(same_but_for_numbers("plugged in: A", "plugged in: B"));
    EXPECT_FALSE(same_but_for_numbers("it", "it 2"));
    EXPECT_FALSE(same_but_for_numbers("2", ""));
    EXPECT_FALSE(same_but_for_numbers("a.", "a"));
    EXPECT_FALSE(same_but_for_numbers("a-b", "a-1"));
}

TEST(Happenings, AreCountedWithFirstAndLastTime) {
    Happenings happenings;
    EXPECT_EQ(happenings.add(at(5), "head-lost", "not tracked"), 0U);
    EXPECT_EQ(happenings.add({}, "tracker", "gone: 3"), 1U);
    EXPECT_EQ(happenings.add(at(9), "head-lost", "not tracked"), 0U);
    EXPECT_EQ(happenings.add(at(12), "tracker", "gone: 4"), 1U);
    EXPECT_EQ(happenings.add(at(13), "display", "not tracked"), 2U) << "another kind";
    ASSERT_EQ(happenings.list().size(), 3U);
    const Happening& head = happenings.list()[0];
    EXPECT_EQ(head.kind.view(), "head-lost");
    EXPECT_EQ(head.weight, frame::EventWeight::Warning);
    EXPECT_EQ(head.times, 2U);
    EXPECT_EQ(head.first, at(5));
    EXPECT_EQ(head.last, at(9));
    const Happening& tracker = happenings.list()[1];
    EXPECT_EQ(tracker.weight, frame::EventWeight::Notice);
    EXPECT_EQ(tracker.first, at(12)) << "of those whose time is known";
    EXPECT_EQ(tracker.text.view(), "gone: 4") << "the last one's";
}

TEST(Happenings, KeepToTheirMemory) {
    const auto text = [](std::size_t i) { return std::string(i + 1, 'x') + std::string(300, 'y'); };
    Happenings happenings;
    std::vector<std::string> texts;
    texts.reserve(Happenings::kMost + 5);
    for (std::size_t i = 0; i < Happenings::kMost + 5; ++i) {
        texts.push_back(text(i));
    }
    const std::size_t before = tests::allocations_of_this_thread();
    for (std::size_t i = 0; i < texts.size(); ++i) {
        EXPECT_EQ(happenings.add(at(1), "origin", texts[i]), std::min(i, Happenings::kOthers));
    }
    EXPECT_EQ(tests::allocations_of_this_thread(), before);
    EXPECT_EQ(happenings.list().size(), Happenings::kMost);
    EXPECT_EQ(happenings.others(), 5U);
    EXPECT_EQ(happenings.add(at(2), "origin", texts[0]), 0U) << "known ones are still counted";
}

TEST(EventKinds, HaveNamesThatRecordingsKeep) {
    std::set<std::string_view> names;
    for (const frame::EventKind& kind : frame::kEventKinds) {
        EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
        EXPECT_LE(kind.name.size(), 32U);
        EXPECT_EQ(kind.name.find(' '), std::string_view::npos) << kind.name;
        EXPECT_EQ(frame::weight_of(kind.name), kind.weight) << kind.name;
    }
    EXPECT_EQ(frame::weight_of("of-a-later-version"), frame::EventWeight::Notice);
}

}  // namespace
}  // namespace gazeloop::latency
