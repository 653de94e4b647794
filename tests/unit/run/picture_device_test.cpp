#include "runtime/run/picture_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace gazeloop::run {
namespace {

const std::vector<NamedValue> kLavapipe{{"vulkan device", "llvmpipe"},
                                        {"vulkan driver", "Mesa 22.3.6"},
                                        {"processor", "of one maker"},
                                        {"processor rsqrt", "01"}};

std::vector<NamedValue> with(std::string_view name, std::string value) {
    std::vector<NamedValue> device = kLavapipe;
    std::ranges::find(device, name, &NamedValue::name)->value = std::move(value);
    return device;
}

TEST(OtherRenderer, IsAnotherDeviceDriverOrTable) {
    EXPECT_EQ(other_renderer(kLavapipe, kLavapipe), "");
    EXPECT_EQ(other_renderer(kLavapipe, with("processor", "a faster one of his")), "");
    EXPECT_EQ(
        other_renderer(kLavapipe, with("processor rsqrt", "02")),
        "recorded with llvmpipe, driver Mesa 22.3.6, on of one maker; this is llvmpipe, driver "
        "Mesa 22.3.6, on of one maker");
    EXPECT_NE(other_renderer(with("vulkan device", "a GPU"), kLavapipe), "");
    EXPECT_NE(other_renderer(with("vulkan driver", "Mesa 25"), kLavapipe), "");
}

TEST(OtherRenderer, IsNotWhatOneOfThemDoesNotKnow) {
    const std::vector<NamedValue> older{{"vulkan device", "llvmpipe"},
                                        {"vulkan driver", "Mesa 22.3.6"}};
    EXPECT_EQ(other_renderer(older, kLavapipe), "");
    EXPECT_EQ(other_renderer(kLavapipe, older), "");
    EXPECT_EQ(other_renderer({}, kLavapipe), "");
}

}  // namespace
}  // namespace gazeloop::run
