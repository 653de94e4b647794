#include "runtime/scene/mesh/check_mesh_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "tests/unit/scene/scene_samples.h"

namespace gazeloop::scene::mesh {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

MeshData sound() {
    MeshData data = square(1.0F, moved({0.0F, 0.0F, -2.0F}));
    data.images.push_back({.width = 1, .height = 1, .texels = decltype(Image::texels)(4)});
    data.lights.push_back({});
    return data;
}

TEST(CheckMeshData, AcceptsWhatIsSound) {
    EXPECT_TRUE(check_mesh_data(sound()).has_value());
    EXPECT_TRUE(check_mesh_data({}).has_value()) << "nothing is a scene too";
}

struct Broken {
    const char* names;  ///< what the message must name
    std::function<void(MeshData&)> damage;
};

TEST(CheckMeshData, NamesTheFirstThingThatIsBroken) {
    const std::vector<Broken> cases{
        {"vertex 2", [](MeshData& d) { d.vertices[2].position_m.y = kNan; }},
        {"vertex 1", [](MeshData& d) { d.vertices[1].normal = {0.0F, 2.0F, 0.0F}; }},
        {"vertex 0", [](MeshData& d) { d.vertices[0].tangent.w = 0.0F; }},
        {"vertex 3", [](MeshData& d) { d.vertices[3].uv[1].x = kInfinity; }},
        {"primitive 0", [](MeshData& d) { d.indices[4] = 4; }},
        {"primitive 0", [](MeshData& d) { d.primitives[0].index_count = 5; }},
        {"primitive 0", [](MeshData& d) { d.primitives[0].index_count = 9; }},
        {"primitive 0", [](MeshData& d) { d.primitives[0].first_index = 0xFFFFFFFAU; }},
        {"primitive 0", [](MeshData& d) { d.primitives[0].first_vertex = 1; }},
        {"primitive 0", [](MeshData& d) { d.primitives[0].material = 1; }},
        {"primitive 0", [](MeshData& d) { d.primitives[0].bounds = {}; }},
        {"detail level 0", [](MeshData& d) { d.levels[0].primitive = kNone; }},
        {"detail level 0", [](MeshData& d) { d.levels[0].error_m = kNan; }},
        {"instance 0", [](MeshData& d) { d.instances[0].level_count = 2; }},
        {"instance 0", [](MeshData& d) { d.instances[0].level_count = 0; }},
        {"instance 0", [](MeshData& d) { d.instances[0].world_from_local[3].z = kInfinity; }},
        {"material 0", [](MeshData& d) { d.materials[0].normal_texture.image = 1; }},
        {"material 0", [](MeshData& d) { d.materials[0].emissive_texture.uv_set = 2; }},
        {"material 0", [](MeshData& d) { d.materials[0].roughness = 1.5F; }},
        {"material 0", [](MeshData& d) { d.materials[0].metallic = kNan; }},
        {"material 0", [](MeshData& d) { d.materials[0].base_color.w = kInfinity; }},
        {"material 0",
         [](MeshData& d) { d.materials[0].base_color_texture.transform[2].y = kNan; }},
        {"image 0", [](MeshData& d) { d.images[0].height = 2; }},
        {"image 0", [](MeshData& d) { d.images[0].width = 0; }},
        {"light 0", [](MeshData& d) { d.lights[0].intensity = -1.0F; }},
        {"light 0", [](MeshData& d) { d.lights[0].direction = {}; }},
        {"light 0", [](MeshData& d) { d.lights[0].range_m = 0.0F; }},
        {"light 0",
         [](MeshData& d) {
             d.lights[0].kind = LightKind::Spot;
             d.lights[0].inner_cone_rad = d.lights[0].outer_cone_rad;
         }},
        {"exposure", [](MeshData& d) { d.exposure = 0.0F; }}};
    for (std::size_t i = 0; i < cases.size(); ++i) {
        MeshData data = sound();
        cases[i].damage(data);
        const auto checked = check_mesh_data(data);
        ASSERT_FALSE(checked.has_value()) << "case " << i;
        EXPECT_EQ(checked.error().kind, ErrorKind::BadInput);
        EXPECT_THAT(checked.error().message, testing::HasSubstr(cases[i].names)) << "case " << i;
    }
}

}  // namespace
}  // namespace gazeloop::scene::mesh
