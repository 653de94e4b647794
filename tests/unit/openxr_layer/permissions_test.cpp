#include "runtime/openxr_layer/permissions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gazeloop::openxr_layer {
namespace {

using Answer = Permissions::Answer;

TEST(Permissions, AreReadAsTheyAreWritten) {
    Permissions permissions;
    permissions.set("/opt/one", Answer::Allowed);
    permissions.set("/opt/a \"game\"/b.x86_64", Answer::Denied);
    permissions.set("/opt/three", Answer::Denied);
    permissions.set("/opt/three", Answer::Unknown);
    const auto read = Permissions::parse(permissions.text(), "file");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->all(), permissions.all());
    EXPECT_EQ(read->of("/opt/one"), Answer::Allowed);
    EXPECT_EQ(read->of("/opt/a \"game\"/b.x86_64"), Answer::Denied);
    EXPECT_EQ(read->of("/opt/three"), Answer::Unknown);
}

TEST(Permissions, NameTheLineThatIsWrong) {
    for (const char* text : {"\n\"/bin/a\" = \"perhaps\"\n", "\n\"/bin/a\" = true\n", "\n[table]\n",
                             "\n\"/bin/a\" = \n"}) {
        const auto read = Permissions::parse(text, "file");
        ASSERT_FALSE(read) << text;
        EXPECT_EQ(read.error().kind, ErrorKind::BadInput);
        EXPECT_THAT(read.error().message, testing::StartsWith("file:2")) << text;
    }
}

}  // namespace
}  // namespace gazeloop::openxr_layer
