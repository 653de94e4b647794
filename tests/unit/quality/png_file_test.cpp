#include "runtime/render/png_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <filesystem>
#include <fstream>

#include "runtime/render/srgb.h"
#include "tests/support/temporary_folder.h"

namespace gazeloop::render {
namespace {

using testing::HasSubstr;

/// A PNG of these samples in memory.
template <typename Sample>
std::vector<std::byte> encoded(std::uint32_t format, std::uint32_t width, std::uint32_t height,
                               const std::vector<Sample>& samples) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = width;
    image.height = height;
    image.format = format;
    png_alloc_size_t size = 0;
    EXPECT_NE(png_image_write_get_memory_size(image, size, 0, samples.data(), 0, nullptr), 0);
    std::vector<std::byte> bytes(size);
    EXPECT_NE(png_image_write_to_memory(&image, bytes.data(), &size, 0, samples.data(), 0, nullptr),
              0);
    bytes.resize(size);
    return bytes;
}

TEST(PngFile, ReadsEveryCodeInLinearLight) {
    std::vector<std::uint8_t> codes;
    for (int code = 0; code < 256; ++code) {
        codes.insert(codes.end(), {static_cast<std::uint8_t>(code), 0, 255});
    }
    const auto picture = read_png(encoded(PNG_FORMAT_RGB, 256, 1, codes), "made");
    ASSERT_TRUE(picture);
    for (std::size_t code = 0; code < 256; ++code) {
        EXPECT_NEAR(picture->pixels[code].x, srgb_decoded(static_cast<double>(code) / 255.0), 1e-7);
        EXPECT_EQ(picture->pixels[code].y, 0.0F);
        EXPECT_EQ(picture->pixels[code].z, 1.0F);
    }
}

TEST(PngFile, ReadsGreyAlphaAnd16Bits) {
    const auto grey = read_png(encoded<std::uint8_t>(PNG_FORMAT_GRAY, 2, 1, {0, 128}), "made");
    EXPECT_NEAR(grey->pixels[1].x, 0.21586, 1e-4);
    EXPECT_EQ(grey->pixels[1].x, grey->pixels[1].z);
    // Alpha is over black.
    const auto alpha = read_png(
        encoded<std::uint8_t>(PNG_FORMAT_RGBA, 2, 1, {255, 0, 0, 255, 255, 0, 0, 0}), "made");
    EXPECT_EQ(alpha->pixels[0].x, 1.0F);
    EXPECT_EQ(alpha->pixels[1].x, 0.0F);
    const auto deep = read_png(
        encoded<std::uint16_t>(PNG_FORMAT_LINEAR_RGB, 2, 1, {65535, 0, 300, 1000, 32768, 0}),
        "made");
    EXPECT_EQ(deep->pixels[0].x, 1.0F);
    EXPECT_NEAR(deep->pixels[0].z, 300.0 / 65535.0, 2e-5);
    EXPECT_NEAR(deep->pixels[1].y, 32768.0 / 65535.0, 2e-5);
}

TEST(PngFile, ReadsWhatItWrites) {
    const tests::TemporaryFolder folder;
    const std::filesystem::path file = folder / "picture.png";
    Picture picture{3, 2, {}};
    for (std::uint8_t i = 0; i < 6; ++i) {
        picture.pixels.push_back({static_cast<std::uint8_t>(40 * i), i, 255});
    }
    ASSERT_TRUE(write_png(picture, file));
    const auto read = read_png(file);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->width, 3U);
    EXPECT_EQ(read->height, 2U);
    for (std::size_t at = 0; at < picture.pixels.size(); ++at) {
        EXPECT_EQ(read->pixels[at], linear_of(picture.pixels[at]));
    }
}

TEST(PngFile, RefusesWithTheFile) {
    const tests::TemporaryFolder folder;
    const auto refusal = [](const auto& result) {
        EXPECT_EQ(result.error().kind, ErrorKind::BadInput);
        return result.error().message;
    };
    EXPECT_THAT(refusal(read_png(folder / "none.png")), HasSubstr("none.png"));
    std::vector<std::byte> bytes =
        encoded<std::uint8_t>(PNG_FORMAT_GRAY, 64, 64, std::vector<std::uint8_t>(4096, 7));
    EXPECT_THAT(refusal(read_png(std::span(bytes).first(bytes.size() / 2), "half")),
                HasSubstr("half"));
    EXPECT_THAT(refusal(read_png(std::span<const std::byte>(), "empty")), HasSubstr("empty"));
    // A header that claims more than the file can hold: width and height are its bytes 16 to 23.
    for (std::size_t at : {18U, 22U}) {
        bytes[at] = std::byte{0x40};
    }
    EXPECT_THAT(refusal(read_png(bytes, "claims")), HasSubstr("claims"));
    // One that claims more than is read.
    bytes = encoded<std::uint8_t>(PNG_FORMAT_GRAY, 20000, 1, std::vector<std::uint8_t>(20000, 7));
    EXPECT_THAT(refusal(read_png(bytes, "wide")), HasSubstr("20000x1"));
}

}  // namespace
}  // namespace gazeloop::render
