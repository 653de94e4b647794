#include "drivers/device/last_words.h"

#include <gtest/gtest.h>

#include <string>

namespace gazeloop::drivers {
namespace {

std::string g_said;

void remember(std::string_view line) noexcept { g_said = line; }

TEST(LastWords, GoWhereTheProgramSays) {
    set_last_words(&remember);
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    say_last_words("the device is left");
    EXPECT_EQ(g_said, "the device is left");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    set_last_words(nullptr);
}

TEST(LastWords, NeverGoToStdoutOfAProgramThatSaysNothing) {
    g_said.clear();
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    say_last_words("the device is left");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "gazeloop: the device is left\n");
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(g_said, "");
}

}  // namespace
}  // namespace gazeloop::drivers
