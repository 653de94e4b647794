// What a file says, held against the standard; what tinygltf 2.7 lets pass in silence.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <glm/geometric.hpp>

#include "tests/support/temporary_folder.h"
#include "tests/unit/scene/gltf/loaded.h"
#include "tests/unit/scene/gltf/spoiled_files.h"

namespace gazeloop::tests {
namespace {

using nlohmann::json;
using testing::HasSubstr;

std::string refusal_of_text(std::string_view text) {
    const auto scene = try_to_load(std::as_bytes(std::span(text)), {});
    return scene ? "" : scene.error().message;
}

class GltfRefuses : public testing::TestWithParam<SpoiledFile> {};

TEST_P(GltfRefuses, WithThePlaceAndTheReason) {
    EXPECT_THAT(refusal_of(patched(GetParam().patch)), HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(Documents, GltfRefuses, testing::ValuesIn(kRefused),
                         [](const auto& at) { return at.param.name; });

class GltfNotes : public testing::TestWithParam<SpoiledFile> {};

TEST_P(GltfNotes, WhatDoesNoHarm) {
    EXPECT_THAT(notes_of(loaded(patched(GetParam().patch))), HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(Documents, GltfNotes, testing::ValuesIn(kNoted),
                         [](const auto& at) { return at.param.name; });

TEST(GltfDocument, WholeFloatsAreIntegers) {
    // tinygltf takes "mesh": 0.0 for absent: an empty scene without a word.
    GltfFile file = one_triangle();
    std::string text = file.text();
    for (const auto& [from, to] : {std::pair{R"("mesh":0)", R"("mesh":0.0)"},
                                   {R"("count":3)", R"("count":3.0)"},
                                   {R"("byteOffset":0)", R"("byteOffset":0.0)"},
                                   {R"("nodes":[0])", R"("nodes":[0.0])"},
                                   {R"("POSITION":0)", R"("POSITION":0e0)"}}) {
        const std::size_t at = text.find(from);
        ASSERT_NE(at, std::string::npos) << from;
        text.replace(at, std::string_view(from).size(), to);
    }
    const auto scene = try_to_load(std::as_bytes(std::span(text)), {{"scene.bin", file.binary}});
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->data.instances.size(), 1U);
    EXPECT_TRUE(scene->notes.empty());
}

TEST(GltfDocument, EmptyObjectsHaveTheStandardsDefaults) {
    GltfFile file = patched(R"({
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0,
            "extensions": {"KHR_texture_transform": {}}}}, "emissiveFactor": [1, 1, 1],
            "extensions": {"KHR_materials_emissive_strength": {}}}],
        "textures": [{"source": 0, "sampler": 0}], "samplers": [{}],
        "images": [{"uri": "missing.png"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"},
            {"type": "spot", "spot": {}}]}},
        "nodes": [{"mesh": 0}, {"extensions": {"KHR_lights_punctual": {"light": 0}}},
                  {"extensions": {"KHR_lights_punctual": {"light": 1}}}, {"camera": 0}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
        "scenes": [{"nodes": [0, 1, 2, 3]}],
        "extensionsUsed": ["KHR_texture_transform", "KHR_materials_emissive_strength",
                           "KHR_lights_punctual"]})");
    const auto data = loaded(file, {}, {.mark_broken_pictures = true}).data;
    const scene::mesh::Material& material = data.materials.at(0);
    EXPECT_EQ(material.base_color, glm::vec4(1));
    EXPECT_EQ(material.metallic, 1.0F);
    EXPECT_EQ(material.roughness, 1.0F);
    EXPECT_EQ(material.emissive, glm::vec3(1));
    EXPECT_EQ(material.alpha_cutoff, 0.5F);
    EXPECT_EQ(material.normal_scale, 1.0F);
    EXPECT_EQ(material.occlusion_strength, 1.0F);
    EXPECT_FALSE(material.double_sided);
    EXPECT_EQ(material.base_color_texture.transform, glm::mat3(1));
    EXPECT_EQ(material.base_color_texture.wrap_u, scene::mesh::Wrap::Repeat);
    ASSERT_EQ(data.lights.size(), 2U);
    EXPECT_EQ(data.lights[0].color, glm::vec3(1));
    EXPECT_EQ(data.lights[0].intensity, 1.0F);
    EXPECT_EQ(data.lights[0].range_m, std::numeric_limits<float>::infinity());
    EXPECT_EQ(data.lights[1].inner_cone_rad, 0.0F);
    EXPECT_FLOAT_EQ(data.lights[1].outer_cone_rad, 0.785398163F);
    ASSERT_EQ(data.viewpoints.size(), 1U);
}

TEST(GltfDocument, TextureTransformsScaleThenTurnThenMove) {
    GltfFile file = patched(R"({
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 1,
            "extensions": {"KHR_texture_transform": {"offset": [3, 1], "scale": [2, 4],
                "rotation": 1.5707963267948966, "texCoord": 0}}}}}],
        "textures": [{"source": 0, "sampler": 0}], "samplers": [{"wrapS": 33071, "wrapT": 33648,
            "magFilter": 9728}],
        "images": [{"uri": "missing.png"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "extensionsUsed": ["KHR_texture_transform"]})");
    const auto scene = loaded(file, {}, {.mark_broken_pictures = true});
    const auto& use = scene.data.materials.at(0).base_color_texture;
    // (1, 0) and (0, 1) become (2, 0) and (0, 4); a quarter turn counter-clockwise as seen, v
    // pointing down, makes them (0, -2) and (4, 0).
    EXPECT_LT(glm::distance(use.transform * glm::vec3(1, 0, 1), glm::vec3(3, -1, 1)), 1e-6F);
    EXPECT_LT(glm::distance(use.transform * glm::vec3(0, 1, 1), glm::vec3(7, 1, 1)), 1e-6F);
    EXPECT_EQ(use.uv_set, 0U);
    EXPECT_EQ(use.wrap_u, scene::mesh::Wrap::Clamp);
    EXPECT_EQ(use.wrap_v, scene::mesh::Wrap::Mirror);
    EXPECT_TRUE(use.nearest);
    EXPECT_THAT(notes_of(scene), HasSubstr("TEXCOORD_0, which it lacks"));
}

TEST(GltfDocument, ANumberOfAnExtensionMayBeWrittenAsAnInteger) {
    // tinygltf keeps extension numbers as int, and 3000000000 would wrap around.
    GltfFile file = patched(R"({"materials": [{"emissiveFactor": [1, 0, 0], "extensions":
        {"KHR_materials_emissive_strength": {"emissiveStrength": 3000000000}}}],
        "extensionsUsed": ["KHR_materials_emissive_strength"],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}]})");
    EXPECT_EQ(loaded(file).data.materials.at(0).emissive.x, 3e9F);
}

TEST(GltfDocument, UnlitMaterialsEmitTheirBaseColour) {
    GltfFile file = patched(R"({"materials": [{"pbrMetallicRoughness":
        {"baseColorFactor": [0.1, 0.2, 0.3, 1]}, "emissiveFactor": [1, 1, 1],
        "extensions": {"KHR_materials_unlit": {}}}], "extensionsUsed": ["KHR_materials_unlit"],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}]})");
    const scene::mesh::Material material = loaded(file).data.materials.at(0);
    EXPECT_TRUE(material.unlit);
    EXPECT_EQ(material.emissive, glm::vec3(0.1F, 0.2F, 0.3F));
}

TEST(GltfDocument, NodesComposeAndMayMirror) {
    GltfFile file = patched(R"({"nodes": [
        {"translation": [1, 2, 3], "scale": [2, 2, -2], "children": [1]},
        {"rotation": [0, 0, 0.7071067811865476, 0.7071067811865476], "children": [2]},
        {"translation": [1, 0, 0], "mesh": 0}]})");
    const auto data = loaded(file).data;
    const glm::mat4x3& placed = data.instances.at(0).world_from_local;
    // The child's place (1, 0, 0) turns to (0, 1, 0), doubles, and moves.
    EXPECT_LT(glm::distance(placed[3], glm::vec3(1, 4, 3)), 1e-6F);
    EXPECT_LT(glm::distance(placed[0], glm::vec3(0, 2, 0)), 1e-6F);
    EXPECT_LT(glm::determinant(glm::mat3(placed)), 0.0F);
}

TEST(GltfDocument, LightsAndCamerasShineAlongTheirNodesMinusZ) {
    GltfFile file = patched(R"({
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "directional",
            "color": [1, 0.5, 0], "intensity": 3}]}},
        "extensionsUsed": ["KHR_lights_punctual"],
        "nodes": [{"mesh": 0}, {"rotation": [0.7071067811865476, 0, 0, 0.7071067811865476],
            "translation": [0, 5, 0], "scale": [2, 2, 2],
            "extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "scenes": [{"nodes": [0, 1]}]})");
    const auto data = loaded(file).data;
    ASSERT_EQ(data.lights.size(), 1U);
    // A quarter turn about x takes -z to y.
    EXPECT_LT(glm::distance(data.lights[0].direction, glm::vec3(0, 1, 0)), 1e-6F);
    EXPECT_EQ(data.lights[0].position_m, glm::vec3(0, 5, 0));
    EXPECT_EQ(data.lights[0].color, glm::vec3(1, 0.5, 0));
    EXPECT_EQ(data.lights[0].intensity, 3.0F);
}

TEST(GltfDocument, EqualShapesAreMadeOnce) {
    GltfFile file = patched(R"({"materials": [{"name": "a"}, {"name": "b"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]},
                   {"primitives": [{"attributes": {"POSITION": 0}, "material": 1}]}],
        "nodes": [{"mesh": 0}, {"mesh": 1}, {"mesh": 0}], "scenes": [{"nodes": [0, 1, 2]}]})");
    const auto data = loaded(file).data;
    EXPECT_EQ(data.vertices.size(), 3U);
    EXPECT_EQ(data.primitives.size(), 2U);
    EXPECT_EQ(data.levels.size(), 2U);
    EXPECT_EQ(data.instances.size(), 3U);
    EXPECT_EQ(data.materials.size(), 2U);
}

TEST(GltfDocument, AThirdSetOfTextureCoordinatesIsNoted) {
    GltfFile file = patched(R"({"materials": [{
        "emissiveTexture": {"index": 0, "texCoord": 2}, "normalTexture": {"index": 0},
        "occlusionTexture": {"index": 0, "texCoord": 1}}],
        "textures": [{"source": 0}], "images": [{"uri": "missing.png"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}]})");
    const auto scene = loaded(file, {}, {.mark_broken_pictures = true});
    EXPECT_THAT(notes_of(scene),
                HasSubstr("/materials/0/emissiveTexture: is its material's third set"));
    EXPECT_EQ(scene.data.materials.at(0).normal_texture.uv_set, 0U);
    EXPECT_EQ(scene.data.materials.at(0).occlusion_texture.uv_set, 1U);
    EXPECT_EQ(scene.data.materials.at(0).emissive_texture.image, scene::mesh::kNone);
}

TEST(GltfDocument, AThousandNodesDeepIsFine) {
    GltfFile file = one_triangle();
    json nodes = json::array();
    for (int i = 0; i < 100000; ++i) {
        nodes.push_back({{"children", {i + 1}}});
    }
    nodes.push_back({{"mesh", 0}});
    file.document["nodes"] = nodes;
    EXPECT_EQ(loaded(file).data.instances.size(), 1U);
}

// ---- JSON ---------------------------------------------------------------------------------------

TEST(GltfJson, RefusesWhatIsNone) {
    EXPECT_THAT(refusal_of_text(""), HasSubstr("scene.gltf: is not JSON"));
    EXPECT_THAT(refusal_of_text("{"), HasSubstr("is not JSON"));
    EXPECT_THAT(refusal_of_text("[]"), HasSubstr("its JSON is a list of 0, must be an object"));
    EXPECT_THAT(refusal_of_text(R"({"a": 1e999})"), HasSubstr("is not JSON"));
    EXPECT_THAT(refusal_of_text("{\"a\": \"\xFF\"}"), HasSubstr("is not JSON"));
    EXPECT_THAT(refusal_of_text(R"({"a": NaN})"), HasSubstr("is not JSON"));
    EXPECT_THAT(refusal_of_text("\x7F"
                                "ELF..."),
                HasSubstr("is not JSON"));
}

TEST(GltfJson, RefusesNestingThatWouldEndTheStack) {
    const std::string deep(1000000, '[');
    EXPECT_THAT(refusal_of_text(deep), HasSubstr("nested deeper than 64"));
    std::string text = R"({"asset":{"version":"2.0"},"extras":)";
    for (int i = 0; i < 100000; ++i) {
        text += R"({"a":)";
    }
    EXPECT_THAT(refusal_of_text(text), HasSubstr("nested deeper than 64"));
    EXPECT_THAT(refusal_of_text(R"({"asset": {"version": "[[[\"{{{"}})"),
                HasSubstr("/asset/version"))
        << "brackets in strings do not count";
}

TEST(GltfJson, NotesNamesThatAreThereTwice) {
    GltfFile file = one_triangle();
    std::string text = file.text();
    text.insert(1, R"("scene": 0, )");
    const auto scene = try_to_load(std::as_bytes(std::span(text)), {{"scene.bin", file.binary}});
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_THAT(notes_of(*scene), HasSubstr("two members \"scene\": the last one counts"));
}

TEST(GltfJson, NotesAByteOrderMark) {
    GltfFile file = one_triangle();
    const std::string text = "\xEF\xBB\xBF" + file.text();
    const auto scene = try_to_load(std::as_bytes(std::span(text)), {{"scene.bin", file.binary}});
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_THAT(notes_of(*scene), HasSubstr("byte order mark"));
}

TEST(GltfJson, MessagesHoldNoControlCharacters) {
    const std::string message = refusal_of_text(R"({"asset": {"version": "\u001b[31m"}})");
    EXPECT_THAT(message, HasSubstr("\\u001b[31m"));
    GltfFile file = one_triangle();
    file.document["buffers"] = {{{"uri", "%1B[31m.bin"}, {"byteLength", 36}}};
    EXPECT_THAT(refusal_of(file), HasSubstr("?[31m.bin is not there"));
}

// ---- .glb, URIs ---------------------------------------------------------------------------------

TEST(GltfContainer, AGlbIsTheSameScene) {
    const auto scene = try_to_load(one_triangle().glb(), {});
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->data.vertices.size(), 3U);
    EXPECT_TRUE(scene->notes.empty()) << notes_of(*scene);
}

TEST(GltfContainer, EveryCutIsRefused) {
    const auto whole = one_triangle().glb();
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const auto scene = try_to_load(std::span(whole).first(size), {});
        EXPECT_FALSE(scene) << size;
    }
}

TEST(GltfContainer, RefusesOtherVersionsAndLengths) {
    const auto with_word = [](std::size_t at, std::uint32_t word) {
        auto file = one_triangle().glb();
        for (unsigned i = 0; i < 4; ++i) {
            file[at + i] = static_cast<std::byte>(word >> (8 * i));
        }
        const auto scene = try_to_load(file, {});
        return scene ? "" : scene.error().message;
    };
    EXPECT_THAT(with_word(4, 1), HasSubstr(".glb of version 1"));
    EXPECT_THAT(with_word(8, 0xFFFFFFFF), HasSubstr("says it has 4294967295 bytes"));
    EXPECT_THAT(with_word(12, 0xFFFFFFF0), HasSubstr("a chunk at byte 12 has 4294967280 bytes"));
    EXPECT_THAT(with_word(16, 0x004E4942), HasSubstr("its first chunk is not JSON"));
}

TEST(GltfContainer, NotesBytesAfterTheEnd) {
    auto file = one_triangle().glb();
    file.resize(file.size() + 5);
    const auto scene = try_to_load(file, {});
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_THAT(notes_of(*scene), HasSubstr("has 5 bytes after its end"));
}

std::string base64_of(std::span<const std::byte> bytes) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            bits = bits << 8U |
                   (i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0U);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += i + k > bytes.size() ? '=' : kDigits[bits >> (18 - 6 * k) & 63U];
        }
    }
    return text;
}

TEST(GltfUris, DataUrisOfAnySpelling) {
    // tinygltf compares their heads letter by letter, and takes others for file names.
    for (const char* head :
         {"data:application/octet-stream;base64,", "data:;base64,",
          "DATA:Application/GLTF-Buffer;BASE64,", "data:a/b;charset=x;base64,"}) {
        GltfFile file = one_triangle();
        file.document["buffers"] = {
            {{"uri", head + base64_of(file.binary)}, {"byteLength", file.binary.size()}}};
        EXPECT_EQ(notes_of(loaded(file)), "") << head;
    }
    GltfFile file = one_triangle();
    std::string escaped = "data:application/octet-stream,";
    for (const std::byte byte : file.binary) {
        escaped += fmt::format("%{:02x}", std::to_integer<int>(byte));
    }
    file.document["buffers"] = {{{"uri", escaped}, {"byteLength", file.binary.size()}}};
    EXPECT_EQ(notes_of(loaded(file)), "");
}

TEST(GltfUris, RefusesBase64ThatIsNone) {
    GltfFile file = one_triangle();
    file.document["buffers"] = {{{"uri", "data:;base64,AA*A"}, {"byteLength", 36}}};
    EXPECT_THAT(refusal_of(file), HasSubstr("/buffers/0/uri: its base64 has a byte 0x2a at 2"));
    file.document["buffers"] = {{{"uri", "data:;base64,AAAAA"}, {"byteLength", 36}}};
    EXPECT_THAT(refusal_of(file), HasSubstr("its base64 is cut short"));
    file.document["buffers"] = {{{"uri", "data:" + std::string(1000000, 'x')}, {"byteLength", 36}}};
    EXPECT_LT(refusal_of(file).size(), 300U);
}

TEST(GltfUris, NamesArePercentDecodedAndAPlusIsAPlus) {
    for (const auto& [uri, name] : {std::pair{"my%20scene+1.bin", "my scene+1.bin"},
                                    {"a%2Fb.bin", "a/b.bin"},
                                    {"%C3%A4.bin", "\xC3\xA4.bin"}}) {
        GltfFile file = one_triangle();
        file.document["buffers"] = {{{"uri", uri}, {"byteLength", file.binary.size()}}};
        EXPECT_EQ(notes_of(loaded(file, {{name, file.binary}})), "") << uri;
    }
    for (const char* uri : {"a%", "a%2", "a%zz", "a%00", ""}) {
        GltfFile file = one_triangle();
        file.document["buffers"] = {{{"uri", uri}, {"byteLength", 36}}};
        EXPECT_THAT(refusal_of(file), HasSubstr("/buffers/0/uri: '")) << uri;
    }
}

TEST(GltfUris, ABufferLongerThanItSaysIsFine) {
    // Valid by the standard; tinygltf refuses it.
    GltfFile file = one_triangle();
    auto longer = file.binary;
    longer.resize(100);
    EXPECT_EQ(notes_of(loaded(file, {{"scene.bin", longer}})), "");
}

TEST(GltfFiles, LoadFromAFolder) {
    const TemporaryFolder folder;
    const GltfFile file = one_triangle();
    const std::string text = file.text();
    std::ofstream(folder / "a b.gltf") << text;
    std::ofstream(folder / "scene.bin")
        .write(reinterpret_cast<const char*>(file.binary.data()),
               static_cast<std::streamsize>(file.binary.size()));
    const auto scene = scene::gltf::load_gltf(folder / "a b.gltf");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->data.vertices.size(), 3U);
}

TEST(GltfFiles, RefusesFoldersDevicesAndWhatIsNotThere) {
    const TemporaryFolder folder;
    const auto message = [](const std::filesystem::path& file) {
        const auto scene = scene::gltf::load_gltf(file);
        return scene ? "" : scene.error().message;
    };
    EXPECT_THAT(message(folder / "no.gltf"), HasSubstr("no.gltf: cannot be read (No such file"));
    EXPECT_THAT(message(folder / "no.gltf"), HasSubstr("name a .gltf or .glb file that is there"));
    EXPECT_THAT(message(folder.path()), HasSubstr("is no regular file"));
    EXPECT_THAT(message("/dev/zero"), HasSubstr("/dev/zero: is no regular file"));
    std::ofstream(folder / "scene.gltf") << R"({"asset": {"version": "2.0"}, "scenes": [{}],
        "buffers": [{"uri": "../../../../../../../../dev/zero", "byteLength": 8}]})";
    EXPECT_THAT(message(folder / "scene.gltf"), HasSubstr("is no regular file"));
}

TEST(GltfLimits, ScenesBeyondTheBudgetAreRefusedBeforeMemoryIsTaken) {
    EXPECT_THAT(refusal_of(one_triangle(), {}, {.limits = {.most_bytes = 700}}),
                HasSubstr("more than the 700 that a scene may take"));
}

}  // namespace
}  // namespace gazeloop::tests
