#include "runtime/scene/mesh/mip_chain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

namespace gazeloop::scene::mesh {
namespace {

Image image(std::uint32_t width, std::uint32_t height, ColorSpace space,
            const std::vector<int>& codes) {
    Image made{.width = width, .height = height, .color_space = space};
    for (const int code : codes) {
        for (int channel = 0; channel < 4; ++channel) {
            made.texels.push_back(static_cast<std::byte>(code));
        }
    }
    return made;
}

int code(const MipLevel& level, std::size_t texel, std::size_t channel = 0) {
    return std::to_integer<int>(level.texels[4 * texel + channel]);
}

TEST(MipChain, EndsAtOneTexel) {
    const auto levels = smaller_levels(image(5, 2, ColorSpace::Linear, std::vector<int>(10, 77)));
    ASSERT_EQ(levels.size(), 2U);
    EXPECT_EQ(levels[0].width, 2U);
    EXPECT_EQ(levels[0].height, 1U);
    EXPECT_EQ(levels[1].width, 1U);
    for (const MipLevel& level : levels) {
        for (const std::byte texel : level.texels) {
            EXPECT_EQ(std::to_integer<int>(texel), 77) << "a constant stays itself";
        }
    }
    EXPECT_TRUE(smaller_levels(image(1, 1, ColorSpace::Srgb, {3})).empty());
}

// A blit from 5 to 2 texels drops the middle one.
TEST(MipChain, CoversEveryTexelOfAnOddSizeEvenly) {
    const auto levels = smaller_levels(image(5, 1, ColorSpace::Linear, {0, 0, 250, 0, 0}));
    EXPECT_EQ(code(levels[0], 0), 50) << "half of the middle texel over two and a half";
    EXPECT_EQ(code(levels[0], 1), 50);
    EXPECT_EQ(code(levels[1], 0), 50);
}

TEST(MipChain, AveragesColoursAsLightAndAlphaAsItIs) {
    const auto levels = smaller_levels(image(2, 1, ColorSpace::Srgb, {0, 255}));
    EXPECT_EQ(code(levels[0], 0), 188) << "sRGB code of half the light";
    EXPECT_EQ(code(levels[0], 0, 3), 128);
    EXPECT_EQ(code(smaller_levels(image(2, 1, ColorSpace::Linear, {0, 255}))[0], 0), 128);
}

// The mean of every two codes, of all 65536 pairs, by the formula of IEC 61966-2-1.
TEST(MipChain, RoundsEveryMeanOfTwoColoursAsTheFormulaDoes) {
    const auto light = [](float code) {
        return code <= 0.04045F ? code / 12.92F : std::pow((code + 0.055F) / 1.055F, 2.4F);
    };
    for (int a = 0; a < 256; ++a) {
        std::vector<int> codes;
        for (int b = 0; b < 256; ++b) {
            codes.insert(codes.end(), {a, b});
        }
        const auto level = smaller_levels(image(512, 1, ColorSpace::Srgb, codes)).front();
        for (int b = 0; b < 256; ++b) {
            const float mean = 0.5F * light(static_cast<float>(a) / 255.0F) +
                               0.5F * light(static_cast<float>(b) / 255.0F);
            const float wanted =
                mean <= 0.0031308F ? 12.92F * mean : 1.055F * std::pow(mean, 1.0F / 2.4F) - 0.055F;
            ASSERT_EQ(code(level, static_cast<std::size_t>(b)), std::lround(255.0F * wanted))
                << a << " and " << b;
        }
    }
}

TEST(MipChain, TakesSquaresOfFour) {
    std::vector<int> codes(16);
    for (int i = 0; i < 16; ++i) {
        codes[static_cast<std::size_t>(i)] = 4 * i;
    }
    const auto levels = smaller_levels(image(4, 4, ColorSpace::Linear, codes));
    EXPECT_EQ(code(levels[0], 0), 10) << "0, 4, 16, 20";
    EXPECT_EQ(code(levels[0], 1), 18) << "8, 12, 24, 28";
    EXPECT_EQ(code(levels[0], 2), 42) << "32, 36, 48, 52";
    EXPECT_EQ(code(levels[0], 3), 50) << "40, 44, 56, 60";
    EXPECT_EQ(code(levels[1], 0), 30);
}

TEST(MipChain, KeepsSixteenBits) {
    Image deep{.width = 2, .height = 1, .format = TexelFormat::Rgba16};
    deep.texels.resize(16);
    const std::array<std::uint16_t, 8> codes{1000, 0, 65535, 1, 1001, 0, 65535, 4};
    std::memcpy(deep.texels.data(), codes.data(), sizeof codes);
    const auto levels = smaller_levels(deep);
    std::array<std::uint16_t, 4> mean{};
    ASSERT_EQ(levels[0].texels.size(), sizeof mean);
    std::memcpy(mean.data(), levels[0].texels.data(), sizeof mean);
    EXPECT_NEAR(mean[0], 1000.5, 0.51);
    EXPECT_EQ(mean[1], 0);
    EXPECT_EQ(mean[2], 65535);
    EXPECT_NEAR(mean[3], 2.5, 0.51);
}

// Half the code is .214048 of the light, by the standard's formula in double.
TEST(MipChain, TurnsSixteenBitColoursIntoLightAndLeavesAlpha) {
    Image deep{
        .width = 1, .height = 1, .color_space = ColorSpace::Srgb, .format = TexelFormat::Rgba16};
    const std::array<std::uint16_t, 4> codes{0, 32768, 65535, 32768};
    deep.texels.resize(sizeof codes);
    std::memcpy(deep.texels.data(), codes.data(), sizeof codes);
    const Image light = as_light(deep);
    EXPECT_EQ(light.color_space, ColorSpace::Linear);
    std::array<std::uint16_t, 4> texel{};
    std::memcpy(texel.data(), light.texels.data(), sizeof texel);
    EXPECT_EQ(texel[0], 0);
    EXPECT_NEAR(texel[1], 65535 * 0.214048, 1.0);
    EXPECT_EQ(texel[2], 65535);
    EXPECT_EQ(texel[3], 32768);
}

}  // namespace
}  // namespace gazeloop::scene::mesh
