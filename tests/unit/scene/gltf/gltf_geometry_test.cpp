// Shapes: every kind of component, strides, sparse accessors, strips and fans, frames.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "runtime/scene/gltf/triangles.h"
#include "runtime/scene/gltf/vertex_frames.h"
#include "tests/unit/scene/gltf/loaded.h"

namespace gazeloop::tests {
namespace {

using scene::gltf::Mode;
using scene::gltf::triangles_of;
using scene::mesh::MeshData;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<glm::vec3> corners_of(const MeshData& data) {
    std::vector<glm::vec3> corners;
    const auto& primitive = data.primitives.at(0);
    corners.reserve(primitive.index_count);
    for (std::uint32_t i = 0; i < primitive.index_count; ++i) {
        corners.push_back(
            data.vertices.at(primitive.first_vertex + data.indices.at(primitive.first_index + i))
                .position_m);
    }
    return corners;
}

/// Its corners, whichever of a triangle's comes first.
bool is_turn_of(const std::vector<glm::vec3>& corners, const std::vector<glm::vec3>& wanted) {
    for (std::size_t turn = 0; turn < 3; ++turn) {
        if (corners[0] == wanted[turn] && corners[1] == wanted[(turn + 1) % 3] &&
            corners[2] == wanted[(turn + 2) % 3]) {
            return true;
        }
    }
    return false;
}

const std::vector<glm::vec3> kTriangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

TEST(GltfTriangles, ListsAreKept) {
    EXPECT_THAT(*triangles_of(Mode::Triangles, {5, 6, 7, 7, 6, 8}), ElementsAre(5, 6, 7, 7, 6, 8));
    EXPECT_THAT(*triangles_of(Mode::Triangles, {5, 6, 7, 7}), ElementsAre(5, 6, 7));
}

TEST(GltfTriangles, StripsTurnEverySecond) {
    // p_i = {v_i, v_(i+1+i%2), v_(i+2-i%2)}
    EXPECT_THAT(*triangles_of(Mode::TriangleStrip, {0, 1, 2, 3, 4}),
                ElementsAre(0, 1, 2, 1, 3, 2, 2, 3, 4));
    // A vertex twice joins two strips and shows nothing.
    EXPECT_THAT(*triangles_of(Mode::TriangleStrip, {0, 1, 2, 2, 5}), ElementsAre(0, 1, 2));
    EXPECT_TRUE(triangles_of(Mode::TriangleStrip, {0, 1})->empty());
    EXPECT_TRUE(triangles_of(Mode::TriangleStrip, {})->empty());
}

TEST(GltfTriangles, FansTurnAboutTheFirst) {
    EXPECT_THAT(*triangles_of(Mode::TriangleFan, {9, 1, 2, 3}), ElementsAre(1, 2, 9, 2, 3, 9));
}

TEST(GltfTriangles, PointsAndLinesAreNone) {
    for (const Mode mode : {Mode::Points, Mode::Lines, Mode::LineLoop, Mode::LineStrip}) {
        EXPECT_FALSE(triangles_of(mode, {0, 1, 2}));
    }
}

TEST(GltfGeometry, ATriangleOfNothingButPositions) {
    const auto scene = loaded(one_triangle());
    EXPECT_TRUE(is_turn_of(corners_of(scene.data), kTriangle));
    EXPECT_EQ(notes_of(scene), "");
    EXPECT_EQ(scene.data.vertices.at(0).normal, glm::vec3(0, 0, 1)) << "flat";
    EXPECT_EQ(scene.data.primitives.at(0).bounds.high_m, glm::vec3(1, 1, 0));
    ASSERT_EQ(scene.data.instances.size(), 1U);
    EXPECT_EQ(scene.data.levels.size(), 1U);
    EXPECT_EQ(scene.data.materials.size(), 1U) << "the default one";
}

/// Integers of KHR_mesh_quantization, as they are or normalised.
template <typename Number>
void expect_quantized(Number one, bool normalized, float expected) {
    const Number zero = 0;
    GltfFile made = one_triangle();
    made.binary.clear();
    made.document["bufferViews"] = nlohmann::json::array();
    made.document["accessors"] = nlohmann::json::array();
    // Elements lie at multiples of four bytes, hence one number more each.
    const std::size_t positions =
        made.add_positions<Number>({zero, zero, zero, one, zero, zero, zero, one, zero});
    made.binary.clear();
    made.document["bufferViews"] = nlohmann::json::array();
    made.add_view_of<Number>(
        {zero, zero, zero, zero, one, zero, zero, zero, zero, one, zero, zero});
    made.document["bufferViews"][0]["byteStride"] = 4 * sizeof(Number);
    made.document["accessors"][positions]["normalized"] = normalized;
    made.document["extensionsUsed"] = {"KHR_mesh_quantization"};
    made.document["extensionsRequired"] = {"KHR_mesh_quantization"};
    const auto scene = loaded(made);
    ASSERT_FALSE(scene.data.primitives.empty());
    EXPECT_FLOAT_EQ(scene.data.primitives.at(0).bounds.high_m.x, expected);
}

TEST(GltfGeometry, ReadsEveryComponentType) {
    expect_quantized<std::int8_t>(64, false, 64.0F);
    expect_quantized<std::uint8_t>(200, false, 200.0F);
    expect_quantized<std::int16_t>(-300, false, 0.0F);
    expect_quantized<std::int16_t>(300, false, 300.0F);
    expect_quantized<std::uint16_t>(60000, false, 60000.0F);
    expect_quantized<std::int8_t>(127, true, 1.0F);
    expect_quantized<std::uint8_t>(51, true, 0.2F);
    expect_quantized<std::int16_t>(32767, true, 1.0F);
    expect_quantized<std::uint16_t>(13107, true, 0.2F);
}

TEST(GltfGeometry, NormalisedMinimaAreMinusOne) {
    GltfFile file = one_triangle();
    const std::size_t normals =
        file.add_accessor<std::int8_t>("VEC3", {0, 0, -128, 0, 0, 0, -127, 0, 0, 0, 0, -128});
    file.document["bufferViews"][1]["byteStride"] = 4;
    file.document["accessors"][normals]["count"] = 3;
    file.document["accessors"][normals]["normalized"] = true;
    file.document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = normals;
    file.document["extensionsUsed"] = {"KHR_mesh_quantization"};
    const auto scene = loaded(file);
    EXPECT_EQ(scene.data.vertices.at(0).normal, glm::vec3(0, 0, -1));
}

TEST(GltfGeometry, IndicesOfEveryWidth) {
    const auto with = [](const auto& indices) {
        GltfFile file = one_triangle();
        file.document["meshes"][0]["primitives"][0]["indices"] =
            file.add_accessor("SCALAR", indices);
        return corners_of(loaded(file).data);
    };
    const std::vector<glm::vec3> turned{kTriangle[2], kTriangle[1], kTriangle[0]};
    EXPECT_TRUE(is_turn_of(with(std::vector<std::uint8_t>{2, 1, 0}), turned));
    EXPECT_TRUE(is_turn_of(with(std::vector<std::uint16_t>{2, 1, 0}), turned));
    EXPECT_TRUE(is_turn_of(with(std::vector<std::uint32_t>{2, 1, 0}), turned));
}

TEST(GltfGeometry, InterleavedElementsAreFoundByTheirStride) {
    GltfFile file = one_triangle();
    file.binary.clear();
    file.document["bufferViews"] = nlohmann::json::array();
    const std::vector<float> interleaved{0, 0, 0, 0, 0, -2, 1, 0, 0, 0, 0, -2, 0, 1, 0, 0, 0, -2};
    file.add_view(std::as_bytes(std::span(interleaved)));
    file.document["bufferViews"][0]["byteStride"] = 24;
    file.document["accessors"].push_back({{"bufferView", 0},
                                          {"byteOffset", 12},
                                          {"componentType", 5126},
                                          {"count", 3},
                                          {"type", "VEC3"}});
    file.document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 1;
    const auto scene = loaded(file);
    EXPECT_TRUE(is_turn_of(corners_of(scene.data), kTriangle));
    EXPECT_EQ(scene.data.vertices.at(2).normal, glm::vec3(0, 0, -1)) << "made unit";
}

/// Sparse replacements of the triangle's corner 1 by (3, 0, 0).
GltfFile with_sparse_corner(GltfFile file) {
    const std::size_t where = file.add_view_of<std::uint8_t>({1});
    const std::size_t what = file.add_view_of<float>({3, 0, 0});
    file.document["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", where}, {"componentType", 5121}}},
        {"values", {{"bufferView", what}}}};
    file.document["accessors"][0]["max"] = {3, 1, 0};
    return file;
}

TEST(GltfGeometry, SparseElementsReplaceThoseOfTheView) {
    const auto scene = loaded(with_sparse_corner(one_triangle()));
    EXPECT_TRUE(is_turn_of(corners_of(scene.data), {{0, 0, 0}, {3, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(notes_of(scene), "");
}

TEST(GltfGeometry, SparseElementsReplaceZerosWithoutAView) {
    GltfFile file = with_sparse_corner(one_triangle());
    file.document["accessors"][0].erase("bufferView");
    file.document["accessors"][0]["max"] = {3, 0, 0};
    const auto corners = corners_of(loaded(file).data);
    EXPECT_TRUE(is_turn_of(corners, {{0, 0, 0}, {3, 0, 0}, {0, 0, 0}}));
}

TEST(GltfGeometry, SparseIndicesWithoutAViewAreApplied) {
    // tinygltf refuses indices whose accessor has no view.
    GltfFile file = one_triangle();
    const std::size_t where = file.add_view_of<std::uint8_t>({1, 2});
    const std::size_t what = file.add_view_of<std::uint16_t>({2, 1});
    file.document["accessors"].push_back(
        {{"componentType", 5123},
         {"count", 3},
         {"type", "SCALAR"},
         {"sparse",
          {{"count", 2},
           {"indices", {{"bufferView", where}, {"componentType", 5121}}},
           {"values", {{"bufferView", what}}}}}});
    file.document["meshes"][0]["primitives"][0]["indices"] = 1;
    EXPECT_TRUE(
        is_turn_of(corners_of(loaded(file).data), {kTriangle[0], kTriangle[2], kTriangle[1]}));
}

TEST(GltfGeometry, SparseIndicesMustIncreaseAndExist) {
    GltfFile file = with_sparse_corner(one_triangle());
    file.binary[36] = std::byte{3};
    EXPECT_THAT(refusal_of(file),
                HasSubstr("scene.gltf: /accessors/0/sparse/indices: index 0 is 3; they must"));
    file = with_sparse_corner(one_triangle());
    file.document["accessors"][0]["sparse"]["count"] = 4;
    EXPECT_THAT(refusal_of(file), HasSubstr("/accessors/0/sparse/count: replaces 4 of 3"));
    file.document["accessors"][0]["sparse"]["count"] = 2;
    EXPECT_THAT(refusal_of(file), HasSubstr("end at byte 2 of a view that has 1"));
}

TEST(GltfGeometry, StripsAndFansBecomeTriangles) {
    GltfFile file = one_triangle();
    file.document["meshes"][0]["primitives"][0]["mode"] = 5;
    EXPECT_TRUE(is_turn_of(corners_of(loaded(file).data), kTriangle));
    file.document["meshes"][0]["primitives"][0]["mode"] = 6;
    EXPECT_TRUE(is_turn_of(corners_of(loaded(file).data), kTriangle));
}

TEST(GltfGeometry, PointsAreLeftOutWithANote) {
    GltfFile file = one_triangle();
    file.document["meshes"][0]["primitives"].push_back(
        {{"attributes", {{"POSITION", 0}}}, {"mode", 0}});
    const auto scene = loaded(file);
    EXPECT_EQ(scene.data.instances.size(), 1U);
    EXPECT_THAT(notes_of(scene), HasSubstr("/meshes/0/primitives/1/mode: points and lines"));
}

TEST(GltfGeometry, RefusesNumbersThatAreNone) {
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
          -std::numeric_limits<float>::infinity()}) {
        GltfFile file = one_triangle();
        std::memcpy(&file.binary[16], &bad, sizeof bad);
        EXPECT_THAT(refusal_of(file), HasSubstr("/accessors/0: element 1 is not a finite number"));
    }
}

TEST(GltfGeometry, RefusesIndicesPastTheVertices) {
    GltfFile file = one_triangle();
    file.document["meshes"][0]["primitives"][0]["indices"] =
        file.add_accessor<std::uint16_t>("SCALAR", {0, 1, 3});
    EXPECT_THAT(refusal_of(file), HasSubstr("/accessors/1: index 2 is 3, of 3 vertices"));
    file.document["meshes"][0]["primitives"][0]["indices"] =
        file.add_accessor<std::uint16_t>("SCALAR", {0, 1, 65535});
    EXPECT_THAT(refusal_of(file), HasSubstr("no primitive restart"));
}

TEST(GltfGeometry, NotesBoundsThatAreNotThoseOfTheVertices) {
    GltfFile file = one_triangle();
    file.document["accessors"][0]["max"] = {2, 1, 0};
    EXPECT_THAT(notes_of(loaded(file)), HasSubstr("/accessors/0: its min and max are not"));
}

TEST(GltfGeometry, NotesPositionsOfTooFewSteps) {
    GltfFile file;
    const std::size_t positions =
        file.add_positions<std::uint16_t>({0, 0, 0, 0, 20, 0, 0, 0, 0, 20, 0, 0});
    GltfFile made = one_triangle();
    made.document["bufferViews"] = file.document["bufferViews"];
    made.document["accessors"] = file.document["accessors"];
    made.document["accessors"][positions]["count"] = 3;
    made.document["accessors"][positions]["max"] = {20, 20, 0};
    made.document["bufferViews"][0]["byteStride"] = 8;
    made.document["extensionsUsed"] = {"KHR_mesh_quantization"};
    made.binary = file.binary;
    EXPECT_THAT(notes_of(loaded(made)), HasSubstr("20 steps from end to end"));
}

TEST(GltfGeometry, ReadsTheTextureCoordinatesThatTheMaterialUses) {
    GltfFile file = one_triangle();
    auto& attributes = file.document["meshes"][0]["primitives"][0]["attributes"];
    attributes["TEXCOORD_0"] = file.add_accessor<float>("VEC2", {0, 0, 0, 0, 0, 0});
    attributes["TEXCOORD_3"] =
        file.add_accessor<std::uint16_t>("VEC2", {0, 65535, 0, 65535, 0, 65535});
    file.document["accessors"].back()["normalized"] = true;
    file.document["meshes"][0]["primitives"][0]["material"] = 0;
    file.document["images"] = {{{"uri", "missing.png"}}};
    file.document["textures"] = {{{"source", 0}}};
    file.document["materials"] = {{{"emissiveTexture", {{"index", 0}, {"texCoord", 3}}}}};
    const auto scene = loaded(file, {}, {.mark_broken_pictures = true});
    EXPECT_EQ(scene.data.materials.at(0).emissive_texture.uv_set, 0U);
    EXPECT_EQ(scene.data.vertices.at(0).uv[0], glm::vec2(0, 1));
}

TEST(GltfGeometry, ColoursOfVerticesAreLinearWithAlphaOne) {
    GltfFile file = one_triangle();
    file.document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] =
        file.add_accessor<float>("VEC3", {0.5F, 0, 1, 0.5F, 0, 1, 0.5F, 0, 1});
    const auto color = loaded(file).data.vertices.at(0).color;
    EXPECT_THAT(color, ElementsAre(128, 0, 255, 255));
}

TEST(GltfFrames, TangentsFollowUAndTheSignFollowsV) {
    // An upright picture on z = 0: u along x, v down.
    using scene::mesh::Vertex;
    std::vector<Vertex> vertices(3);
    vertices[0] = {.position_m = {0, 1, 0}, .uv = {glm::vec2(0, 0), {}}};
    vertices[1] = {.position_m = {0, 0, 0}, .uv = {glm::vec2(0, 1), {}}};
    vertices[2] = {.position_m = {1, 0, 0}, .uv = {glm::vec2(1, 1), {}}};
    const std::vector<std::uint32_t> triangle{0, 1, 2};
    scene::gltf::make_tangents(vertices, triangle, 0);
    for (const Vertex& vertex : vertices) {
        EXPECT_LT(glm::distance(vertex.tangent, glm::vec4(1, 0, 0, 1)), 1e-6F);
    }
    // Mirrored in u.
    for (Vertex& vertex : vertices) {
        vertex.uv[0].x = 1.0F - vertex.uv[0].x;
    }
    scene::gltf::make_tangents(vertices, triangle, 0);
    for (const Vertex& vertex : vertices) {
        EXPECT_LT(glm::distance(vertex.tangent, glm::vec4(-1, 0, 0, -1)), 1e-6F);
    }
    // Coordinates that span nothing: some perpendicular.
    for (Vertex& vertex : vertices) {
        vertex.uv[0] = {0.5F, 0.5F};
    }
    scene::gltf::make_tangents(vertices, triangle, 0);
    for (const Vertex& vertex : vertices) {
        EXPECT_NEAR(glm::length(glm::vec3(vertex.tangent)), 1.0F, 1e-6F);
        EXPECT_EQ(glm::dot(glm::vec3(vertex.tangent), vertex.normal), 0.0F);
    }
}

TEST(GltfFrames, NormalsWithoutDirectionComeFromTheTriangles) {
    GltfFile file = one_triangle();
    file.document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
        file.add_accessor<float>("VEC3", {0, 0, 0, 0, 0, 1, 0, 0, 1e-30F});
    const auto scene = loaded(file);
    for (const auto& vertex : scene.data.vertices) {
        EXPECT_EQ(vertex.normal, glm::vec3(0, 0, 1));
    }
    EXPECT_THAT(notes_of(scene), HasSubstr("1 normals have no direction"));
}

TEST(GltfGeometry, LargeShapesGetCoarserFormsOfTheSameVertices) {
    // A wavy sheet of 2 x 64 x 64 triangles.
    constexpr std::uint32_t kSide = 65;
    std::vector<float> positions;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t y = 0; y < kSide; ++y) {
        for (std::uint32_t x = 0; x < kSide; ++x) {
            const float u = static_cast<float>(x) / 64.0F;
            const float v = static_cast<float>(y) / 64.0F;
            positions.insert(positions.end(), {u, v, 0.05F * std::sin(6.0F * u)});
            if (x > 0 && y > 0) {
                const std::uint32_t at = y * kSide + x;
                indices.insert(indices.end(),
                               {at - kSide - 1, at - kSide, at, at - kSide - 1, at, at - 1});
            }
        }
    }
    GltfFile file;
    GltfFile shape = one_triangle();
    file.document = shape.document;
    file.document.erase("accessors");
    file.document.erase("bufferViews");
    auto& primitive = file.document["meshes"][0]["primitives"][0];
    primitive["attributes"]["POSITION"] = file.add_positions(positions);
    primitive["attributes"]["NORMAL"] = file.add_accessor<float>("VEC3", positions);
    file.document["meshes"][0]["primitives"][0]["indices"] = file.add_accessor("SCALAR", indices);
    const MeshData data = loaded(file).data;
    ASSERT_EQ(data.instances.size(), 1U);
    ASSERT_GE(data.instances[0].level_count, 3U);
    for (std::size_t i = 1; i < data.levels.size(); ++i) {
        const auto& finer = data.primitives[data.levels[i - 1].primitive];
        const auto& coarser = data.primitives[data.levels[i].primitive];
        EXPECT_LE(coarser.index_count, finer.index_count / 2);
        EXPECT_EQ(coarser.first_vertex, finer.first_vertex);
        EXPECT_GE(data.levels[i].error_m, data.levels[i - 1].error_m);
        EXPECT_LE(data.levels[i].error_m, 0.02F);
        for (std::uint32_t k = 0; k < coarser.index_count; ++k) {
            EXPECT_LT(data.indices[coarser.first_index + k], coarser.vertex_count);
        }
    }
}

}  // namespace
}  // namespace gazeloop::tests
