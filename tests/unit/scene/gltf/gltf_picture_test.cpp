// Pictures: what is decoded, how, and what is refused before memory is taken.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "runtime/scene/gltf/picture.h"
#include "tests/support/encoded_pictures.h"
#include "tests/unit/scene/gltf/loaded.h"

namespace gazeloop::tests {
namespace {

using scene::gltf::Notes;
using scene::mesh::ColorSpace;
using scene::mesh::Image;
using scene::mesh::TexelFormat;
using testing::ElementsAre;
using testing::HasSubstr;

Image decoded(const std::vector<std::byte>& bytes, Notes& notes) {
    Image image;
    const auto header = scene::gltf::read_picture_header(bytes, "/images/0", {});
    scene::gltf::decode_picture(bytes, header, "/images/0", image, notes);
    return image;
}

Image decoded(const std::vector<std::byte>& bytes) {
    Notes notes;
    Image image = decoded(bytes, notes);
    EXPECT_TRUE(notes.all().empty());
    return image;
}

std::string refusal_of_picture(const std::vector<std::byte>& bytes) {
    try {
        Notes notes;
        (void)decoded(bytes, notes);
        return "";
    } catch (const scene::gltf::Refusal& refusal) {
        return refusal.place() + ": " + refusal.what();
    }
}

std::vector<int> codes_of(const Image& image) {
    std::vector<int> codes;
    codes.reserve(image.texels.size());
    for (const std::byte texel : image.texels) {
        codes.push_back(std::to_integer<int>(texel));
    }
    return codes;
}

std::vector<std::byte> bytes_of_text(std::string_view text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

TEST(GltfPictures, PngsOfEveryKindBecomeRgba) {
    const std::vector<std::uint8_t> rgba{1, 2, 3, 4, 250, 251, 252, 253};
    EXPECT_THAT(codes_of(decoded(encoded_png(2, 1, PNG_FORMAT_RGBA, rgba.data()))),
                ElementsAre(1, 2, 3, 4, 250, 251, 252, 253));
    const std::vector<std::uint8_t> rgb{1, 2, 3, 250, 251, 252};
    EXPECT_THAT(codes_of(decoded(encoded_png(1, 2, PNG_FORMAT_RGB, rgb.data()))),
                ElementsAre(1, 2, 3, 255, 250, 251, 252, 255));
    const std::vector<std::uint8_t> grey{7, 200};
    EXPECT_THAT(codes_of(decoded(encoded_png(2, 1, PNG_FORMAT_GRAY, grey.data()))),
                ElementsAre(7, 7, 7, 255, 200, 200, 200, 255));
    const std::vector<std::uint8_t> indices{1, 0};
    EXPECT_THAT(codes_of(decoded(encoded_png(2, 1, PNG_FORMAT_RGBA_COLORMAP, indices.data(),
                                             {10, 20, 30, 40, 50, 60, 70, 255}))),
                ElementsAre(50, 60, 70, 255, 10, 20, 30, 40));
}

TEST(GltfPictures, SixteenBitsStaySixteenAndGammaIsNotApplied) {
    // libpng writes gAMA 1 into these; applied, it would change every value.
    const std::vector<std::uint16_t> grey{0, 0x1234, 0xFFFF};
    const Image image = decoded(encoded_png(3, 1, PNG_FORMAT_LINEAR_Y, grey.data()));
    ASSERT_EQ(image.format, TexelFormat::Rgba16);
    ASSERT_EQ(image.texels.size(), 24U);
    std::array<std::uint16_t, 12> texels{};
    std::memcpy(texels.data(), image.texels.data(), sizeof texels);
    EXPECT_THAT(texels, ElementsAre(0, 0, 0, 0xFFFF, 0x1234, 0x1234, 0x1234, 0xFFFF, 0xFFFF, 0xFFFF,
                                    0xFFFF, 0xFFFF));
}

TEST(GltfPictures, JpegsBecomeRgba) {
    const Image image = decoded(
        encoded_jpeg(8, 8, JCS_RGB, 3, std::vector<std::uint8_t>(std::size_t{8} * 8 * 3, 100)));
    EXPECT_EQ(image.width, 8U);
    ASSERT_EQ(image.texels.size(), 256U);
    for (std::size_t i = 0; i < 256; ++i) {
        EXPECT_NEAR(std::to_integer<int>(image.texels[i]), i % 4 == 3 ? 255 : 100, 1);
    }
    const Image grey = decoded(
        encoded_jpeg(8, 8, JCS_GRAYSCALE, 1, std::vector<std::uint8_t>(std::size_t{8} * 8, 60)));
    EXPECT_NEAR(std::to_integer<int>(grey.texels[1]), 60, 1);
}

TEST(GltfPictures, AJpegThatEndsEarlyIsShownWithANote) {
    std::vector<std::uint8_t> noise;
    noise.reserve(std::size_t{64} * 64 * 3);
    for (std::uint32_t i = 0; i < 64 * 64 * 3; ++i) {
        noise.push_back(static_cast<std::uint8_t>(i * 2654435761U >> 24U));
    }
    auto bytes = encoded_jpeg(64, 64, JCS_RGB, 3, noise);
    bytes.resize(bytes.size() / 2);
    Notes notes;
    EXPECT_EQ(decoded(bytes, notes).texels.size(), 64U * 64 * 4);
    ASSERT_EQ(notes.all().size(), 1U);
    EXPECT_THAT(notes.all()[0].text, HasSubstr("is a damaged JPEG (Premature end"));
}

TEST(GltfPictures, RefusesWhatIsBrokenAtEveryLength) {
    const std::vector<std::uint8_t> rgba{1, 2, 3, 4, 250, 251, 252, 253};
    const auto png = encoded_png(2, 1, PNG_FORMAT_RGBA, rgba.data());
    constexpr std::size_t kEndChunk = 12;
    for (std::size_t size = 0; size < png.size() - kEndChunk - 4; ++size) {
        EXPECT_NE(refusal_of_picture({png.begin(), png.begin() + static_cast<long>(size)}), "")
            << size;
    }
    auto wrong = png;
    wrong[19] ^= std::byte{1};  // the width, against its checksum
    EXPECT_THAT(refusal_of_picture(wrong), HasSubstr("/images/0: is a PNG that cannot be decoded"));
    EXPECT_THAT(refusal_of_picture(bytes_of_text("\xFF\xD8\xFF\xE0 nothing")),
                HasSubstr("is a JPEG that cannot be decoded"));
}

TEST(GltfPictures, OtherFormatsAreNamed) {
    using namespace std::string_view_literals;
    for (const auto& [bytes, name] : {std::pair{"RIFF\0\0\0\0WEBPVP8 "sv, "a WebP picture"},
                                      {"\xABKTX 20\xBB\r\n\x1A\n"sv, "a KTX2 texture"},
                                      {"GIF89a"sv, "a GIF picture"},
                                      {"DDS |"sv, "a DDS texture"},
                                      {"BM6"sv, "a BMP picture"},
                                      {""sv, "an empty file"},
                                      {"<svg>"sv, "no picture that is known"}}) {
        EXPECT_THAT(refusal_of_picture(bytes_of_text(bytes)), HasSubstr(name));
    }
    const auto print = encoded_jpeg(8, 8, JCS_CMYK, 4, std::vector<std::uint8_t>(256, 9));
    EXPECT_THAT(refusal_of_picture(print), HasSubstr("its colours are CMYK"));
}

/// A PNG whose header states another size.
std::vector<std::byte> stating(std::uint32_t width, std::uint32_t height) {
    const std::vector<std::uint8_t> grey{7};
    auto png = encoded_png(1, 1, PNG_FORMAT_GRAY, grey.data());
    for (unsigned i = 0; i < 4; ++i) {
        png[16 + i] = static_cast<std::byte>(width >> (24 - 8 * i));
        png[20 + i] = static_cast<std::byte>(height >> (24 - 8 * i));
    }
    return png;
}

TEST(GltfPictures, SizesAreBoundedBeforeDecoding) {
    EXPECT_THAT(refusal_of_picture(stating(0, 1)),
                HasSubstr("has 0x1 texels, must have 1 to 16384"));
    EXPECT_THAT(refusal_of_picture(stating(16385, 1)), HasSubstr("has 16385x1 texels"));
    EXPECT_THAT(refusal_of_picture(stating(0xFFFFFFFF, 0xFFFFFFFF)), HasSubstr("make it smaller"));
    EXPECT_THAT(refusal_of_picture(stating(16384, 16384)),
                HasSubstr("states 16384x16384 texels, which its"));
}

/// A triangle whose material uses a picture in these ways.
GltfFile with_picture(const char* material) {
    GltfFile file = one_triangle();
    file.document.merge_patch(nlohmann::json::parse(R"({"textures": [{"source": 0}],
        "images": [{"uri": "a.png"}]})"));
    file.document["materials"] = {nlohmann::json::parse(material)};
    auto& primitive = file.document["meshes"][0]["primitives"][0];
    primitive["material"] = 0;
    primitive["attributes"]["TEXCOORD_0"] = file.add_accessor<float>("VEC2", {0, 0, 1, 0, 0, 1});
    return file;
}

std::vector<std::byte> one_texel() {
    const std::vector<std::uint8_t> rgba{9, 8, 7, 6};
    return encoded_png(1, 1, PNG_FORMAT_RGBA, rgba.data());
}

TEST(GltfTextures, ColoursAndDataAreToldApart) {
    const auto file = with_picture(R"({"emissiveTexture": {"index": 0},
        "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicRoughnessTexture":
        {"index": 0}}, "occlusionTexture": {"index": 0}})");
    const auto data = loaded(file, {{"a.png", one_texel()}}).data;
    ASSERT_EQ(data.images.size(), 2U) << "once in each colour space";
    const auto& material = data.materials.at(0);
    const auto space_of = [&](const scene::mesh::TextureUse& use) {
        return data.images.at(use.image).color_space;
    };
    EXPECT_EQ(space_of(material.base_color_texture), ColorSpace::Srgb);
    EXPECT_EQ(space_of(material.emissive_texture), ColorSpace::Srgb);
    EXPECT_EQ(space_of(material.metallic_roughness_texture), ColorSpace::Linear);
    EXPECT_EQ(space_of(material.occlusion_texture), ColorSpace::Linear);
    EXPECT_EQ(material.normal_texture.image, scene::mesh::kNone);
    EXPECT_THAT(codes_of(data.images[0]), ElementsAre(9, 8, 7, 6));
    EXPECT_EQ(data.images[0].name, "a.png");
}

TEST(GltfTextures, PicturesMayLieInAView) {
    auto file = with_picture(R"({"emissiveTexture": {"index": 0}})");
    const std::size_t view = file.add_view_of(one_texel());
    file.document["images"] = {{{"bufferView", view}, {"mimeType", "image/png"}}};
    EXPECT_EQ(loaded(file).data.images.at(0).name, "/images/0");
}

TEST(GltfTextures, AMissingPictureIsRefusedOrMarked) {
    const auto file = with_picture(R"({"emissiveTexture": {"index": 0}})");
    EXPECT_THAT(refusal_of(file), HasSubstr("/images/0: a.png is not there"));
    const auto scene = loaded(file, {}, {.mark_broken_pictures = true});
    EXPECT_THAT(notes_of(scene),
                HasSubstr("shown as magenta and black (used by /materials/0/emissiveTexture)"));
    EXPECT_EQ(scene.data.images.at(0).width, 8U);
    EXPECT_EQ(std::to_integer<int>(scene.data.images[0].texels[0]), 255);
}

TEST(GltfTextures, PicturesThatNothingUsesAreNotDecoded) {
    // tinygltf fails over one that it cannot decode.
    auto file = one_triangle();
    file.document["images"] = {{{"uri", "data:image/png;base64,AAAA"}}, {{"uri", "gone.webp"}}};
    file.document["textures"] = {{{"source", 1}}};
    EXPECT_TRUE(loaded(file).data.images.empty());
}

TEST(GltfTextures, AFallbackOfAnOptionalFormatIsShown) {
    auto file = with_picture(R"({"emissiveTexture": {"index": 0}})");
    file.document.merge_patch(nlohmann::json::parse(R"({
        "textures": [{"source": 0, "extensions": {"EXT_texture_webp": {"source": 1}}}],
        "images": [{"uri": "a.png"}, {"uri": "a.webp"}], "extensionsUsed": ["EXT_texture_webp"]})"));
    auto scene = loaded(file, {{"a.png", one_texel()}});
    EXPECT_EQ(scene.data.images.size(), 1U);
    EXPECT_THAT(notes_of(scene), HasSubstr("EXT_texture_webp is not supported"));
    file.document["textures"][0].erase("source");
    scene = loaded(file, {{"a.png", one_texel()}});
    EXPECT_TRUE(scene.data.images.empty());
    EXPECT_THAT(notes_of(scene), HasSubstr("/textures/0: has a picture only by an extension"));
}

TEST(GltfTextures, TogetherTheyAreHeldToTheBudget) {
    const auto file = with_picture(R"({"emissiveTexture": {"index": 0}})");
    const std::vector<std::uint8_t> grey(std::size_t{256} * 256, 7);
    EXPECT_THAT(refusal_of(file, {{"a.png", encoded_png(256, 256, PNG_FORMAT_GRAY, grey.data())}},
                           {.limits = {.most_bytes = 100000}}),
                HasSubstr("/images/0: its texels need 262144 bytes"));
}

TEST(GltfTextures, ThreadsChangeNothing) {
    auto file = with_picture(R"({"emissiveTexture": {"index": 0}})");
    std::size_t told = 0;
    const scene::gltf::LoadOptions options{.threads = 4,
                                           .progress = [&](std::size_t done, std::size_t total) {
                                               EXPECT_EQ(done, ++told);
                                               EXPECT_EQ(total, 2U);
                                           }};
    EXPECT_EQ(loaded(file, {{"a.png", one_texel()}}, options).data.images.size(), 1U);
    EXPECT_EQ(told, 2U);
}

}  // namespace
}  // namespace gazeloop::tests
