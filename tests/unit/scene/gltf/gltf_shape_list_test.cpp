#include <gtest/gtest.h>

#include "runtime/scene/gltf/shape_list.h"

namespace gazeloop::scene::gltf {
namespace {

Geometry triangle_at(float x_m) {
    Geometry geometry;
    geometry.vertices.resize(3);
    for (mesh::Vertex& vertex : geometry.vertices) {
        vertex.position_m.x = x_m;
    }
    geometry.indices = {0, 1, 2};
    return geometry;
}

TEST(GltfShapeList, HoldsShapesInTheirOrderWhoeverIsFirst) {
    mesh::MeshData data;
    ShapeList shapes(3, data);
    shapes.put(2, triangle_at(2.0F));
    EXPECT_TRUE(data.vertices.empty()) << "it waits for those before it";
    shapes.put(0, triangle_at(0.0F));
    EXPECT_EQ(data.vertices.size(), 3U);
    shapes.put(1, {});
    ASSERT_EQ(data.vertices.size(), 6U);
    EXPECT_EQ(data.vertices[3].position_m.x, 2.0F);

    EXPECT_EQ(shapes.add_levels(1, 0).second, 0U) << "an empty shape has no form";
    const auto [first, count] = shapes.add_levels(2, 5);
    ASSERT_EQ(count, 1U);
    const mesh::Primitive& primitive = data.primitives.at(data.levels.at(first).primitive);
    EXPECT_EQ(primitive.first_vertex, 3U);
    EXPECT_EQ(primitive.vertex_count, 3U);
    EXPECT_EQ(primitive.first_index, 3U);
    EXPECT_EQ(primitive.index_count, 3U);
    EXPECT_EQ(primitive.material, 5U);
    EXPECT_EQ(primitive.bounds.low_m.x, 2.0F);
}

}  // namespace
}  // namespace gazeloop::scene::gltf
