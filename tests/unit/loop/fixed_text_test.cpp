#include "runtime/fixed_text.h"

#include <gtest/gtest.h>

#include <string>

namespace gazeloop {
namespace {

TEST(FixedText, KeepsWhatFits) {
    EXPECT_EQ(FixedText<4>().view(), "");
    EXPECT_EQ(FixedText<4>("abcd").view(), "abcd");
    EXPECT_EQ(FixedText<4>(std::string_view("a\0b", 3)).view(), std::string_view("a\0b", 3));
}

TEST(FixedText, CutsBetweenCharacters) {
    EXPECT_EQ(FixedText<4>("abcde").view(), "abcd");
    EXPECT_EQ(FixedText<4>("abc\u00e9").view(), "abc");
    EXPECT_EQ(FixedText<4>("ab\u00e9\u00e9").view(), "ab\u00e9");
    EXPECT_EQ(FixedText<4>("a\U0001f441").view(), "a");
    EXPECT_EQ(FixedText<4>("\U0001f441\U0001f441").view(), "\U0001f441");
}

TEST(FixedText, CutsWhatIsNoUtf8AtItsSize) {
    EXPECT_EQ(FixedText<6>(std::string(9, '\x80')).view(), std::string(6, '\x80'));
}

}  // namespace
}  // namespace gazeloop
