// BC1 by a decoder that is written after the format's description (Khronos Data Format, S3TC).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

#include "runtime/scene/block_compression.h"

namespace gazeloop::scene {
namespace {

struct Codes {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::byte> rgba{};

    void put(int r, int g, int b) {
        for (const int code : {r, g, b, 255}) {
            rgba.push_back(static_cast<std::byte>(code));
        }
    }
    [[nodiscard]] int at(std::uint32_t x, std::uint32_t y, std::uint32_t c) const {
        return std::to_integer<int>(rgba[4 * (std::size_t{y} * width + x) + c]);
    }
};

Codes decoded(const std::vector<std::byte>& bc1, std::uint32_t width, std::uint32_t height) {
    Codes out{width, height, std::vector<std::byte>(std::size_t{4} * width * height)};
    const auto word = [&](std::size_t at) {
        return std::to_integer<int>(bc1[at]) | std::to_integer<int>(bc1[at + 1]) << 8;
    };
    const auto widened = [](int colour) {
        return std::array{(colour >> 11) * 255 / 31.0, (colour >> 5 & 63) * 255 / 63.0,
                          (colour & 31) * 255 / 31.0};
    };
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const std::size_t block = 8 * (std::size_t{y / 4} * ((width + 3) / 4) + x / 4);
            const int first = word(block);
            const int second = word(block + 2);
            const std::uint32_t texel = y % 4 * 4 + x % 4;
            const int index =
                std::to_integer<int>(bc1[block + 4 + texel / 4]) >> (2 * (texel % 4)) & 3;
            EXPECT_TRUE(first > second || index == 0) << "else it may be black";
            constexpr std::array kSecond{0.0, 1.0, 1.0 / 3.0, 2.0 / 3.0};
            const double share = kSecond.at(static_cast<std::size_t>(index));
            for (std::uint32_t c = 0; c < 3; ++c) {
                const double code =
                    widened(first).at(c) * (1.0 - share) + widened(second).at(c) * share;
                out.rgba[4 * (std::size_t{y} * width + x) + c] =
                    static_cast<std::byte>(std::lround(code));
            }
        }
    }
    return out;
}

struct Loss {
    int most = 0;
    double rms = 0.0;
};

Loss loss_of(const Codes& picture) {
    const auto packed = compress_bc1(picture.rgba, picture.width, picture.height);
    EXPECT_EQ(packed.size(), bc1_bytes(picture.width, picture.height));
    const Codes again = decoded(packed, picture.width, picture.height);
    Loss loss;
    for (std::uint32_t y = 0; y < picture.height; ++y) {
        for (std::uint32_t x = 0; x < picture.width; ++x) {
            for (std::uint32_t c = 0; c < 3; ++c) {
                const int off = std::abs(again.at(x, y, c) - picture.at(x, y, c));
                loss.most = std::max(loss.most, off);
                loss.rms += off * off;
            }
        }
    }
    loss.rms = std::sqrt(loss.rms / (3.0 * picture.width * picture.height));
    return loss;
}

TEST(BlockCompression, TakesAnEighthAndWholeBlocks) {
    EXPECT_EQ(bc1_bytes(1024, 1024), 1024U * 1024 * 4 / 8);
    EXPECT_EQ(bc1_bytes(5, 1), 16U);
}

// Half a step of 5 bits is 4.1 codes; rounding on both sides may add one.
TEST(BlockCompression, OfOneColourIsOffByItsQuantisation) {
    for (int code = 0; code < 256; ++code) {
        Codes flat{4, 4};
        for (int i = 0; i < 16; ++i) {
            flat.put(code, 255 - code, code / 2);
        }
        EXPECT_LE(loss_of(flat).most, 5) << code;
    }
}

// On one line through colours, nothing is farther off than half of what a third of the line is,
// and a quantisation.
TEST(BlockCompression, OfAGradientIsOffByHalfAStep) {
    for (const int contrast : {3, 24, 80, 240}) {
        Codes ramp{16, 8};
        for (int y = 0; y < 8; ++y) {
            for (int x = 0; x < 16; ++x) {
                const int code = contrast * (x % 4 * 4 + y % 4) / 15;
                ramp.put(code, code, code);
            }
        }
        EXPECT_LE(loss_of(ramp).most, contrast / 6 + 6) << contrast;
    }
}

// Two colours of a block, an edge, are both kept.
TEST(BlockCompression, KeepsEdges) {
    Codes edge{8, 8};
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 8; ++x) {
            x + y < 7 ? edge.put(250, 40, 10) : edge.put(20, 90, 200);
        }
    }
    EXPECT_LE(loss_of(edge).most, 5);
}

TEST(BlockCompression, OfSidesThatAreNoBlocksRepeatsTheEdge) {
    Codes odd{7, 5};
    for (int y = 0; y < 5; ++y) {
        for (int x = 0; x < 7; ++x) {
            odd.put(30 * x, 30 * x, 30 * x);
        }
    }
    EXPECT_LE(loss_of(odd).most, 90 / 6 + 6);
}

// Noise is the worst: no line fits it. A line of three colours' noise keeps a third of its variance
// across it at best; that of 255 / sqrt(12) = 74 codes leaves at most 60.
TEST(BlockCompression, OfNoiseLosesWhatNoLineHolds) {
    std::mt19937 random(1);
    Codes noise{64, 64};
    for (int i = 0; i < 64 * 64; ++i) {
        const auto any = [&] { return static_cast<int>(random() % 256); };
        const int r = any();
        const int g = any();
        noise.put(r, g, any());
    }
    const double rms = loss_of(noise).rms;
    EXPECT_LT(rms, 60.0);
    EXPECT_GT(rms, 20.0) << "it cannot be kept";
}

}  // namespace
}  // namespace gazeloop::scene
