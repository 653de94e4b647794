// Where the viewer of a scene from a file starts.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "runtime/scene/gltf/viewer_place.h"
#include "tests/unit/scene/gltf/loaded.h"
#include "tests/unit/scene/gltf/spoiled_files.h"

namespace gazeloop::tests {
namespace {

TEST(GltfViewer, StandsInFrontOfASceneWithoutACamera) {
    // From (10, 0, 5) to (14, 2, 5): seen from (12, 1, 7).
    auto data = loaded(patched(R"({"nodes": [{"mesh": 0, "translation": [10, 0, 5],
        "scale": [4, 2, 1]}]})"))
                    .data;
    scene::gltf::place_before_viewer(data);
    EXPECT_LT(glm::distance(data.instances.at(0).world_from_local[3], glm::vec3(-2, -1, -2)),
              1e-6F);
    EXPECT_EQ(data.instances.at(0).world_from_local[0], glm::vec3(4, 0, 0));
}

TEST(GltfViewer, StartsAtTheFirstCameraUpright) {
    // The camera stands at (1, 2, 3), turned a quarter to the left (looking along -X) and down.
    auto scene = loaded(patched(R"({"cameras": [{"type": "perspective",
        "perspective": {"yfov": 1, "znear": 0.1}}],
        "nodes": [{"mesh": 0, "translation": [-4, 2, 3]},
                  {"translation": [1, 2, 3], "rotation": [0, 0.7071067811865476, 0,
                   0.7071067811865476], "children": [2]},
                  {"camera": 0, "rotation": [-0.3826834323650898, 0, 0, 0.9238795325112867]}],
        "scenes": [{"nodes": [0, 1]}],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "spot": {}}]}},
        "extensionsUsed": ["KHR_lights_punctual"]})"));
    for (const scene::gltf::Note& note : scene.notes) {  // what the standard knows is not left out
        EXPECT_EQ(note.place.find("/cameras"), std::string::npos) << note_text(note);
    }
    auto& data = scene.data;
    scene::mesh::Light light;
    light.position_m = {-4, 2, 3};
    light.direction = {-1, 0, 0};
    data.lights.push_back(light);
    scene::gltf::place_before_viewer(data);
    EXPECT_LT(glm::distance(data.instances.at(0).world_from_local[3], glm::vec3(0, 0, -5)), 1e-5F);
    EXPECT_LT(glm::distance(data.lights.at(0).position_m, glm::vec3(0, 0, -5)), 1e-5F);
    EXPECT_LT(glm::distance(data.lights.at(0).direction, glm::vec3(0, 0, -1)), 1e-6F);
    const glm::mat4x3& camera = data.viewpoints.at(0).world_from_camera;
    EXPECT_LT(glm::distance(camera[3], glm::vec3(0)), 1e-5F);
    EXPECT_NEAR(camera[2].y, std::sqrt(0.5F), 1e-6F) << "it still looks down";
}

TEST(GltfViewer, ACameraThatLooksStraightDownLeavesTheHeading) {
    auto data = loaded(patched(R"({"cameras": [{"type": "perspective",
        "perspective": {"yfov": 1, "znear": 0.1}}],
        "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0, 9, 0],
                   "rotation": [-0.7071067811865476, 0, 0, 0.7071067811865476]}],
        "scenes": [{"nodes": [0, 1]}]})"))
                    .data;
    scene::gltf::place_before_viewer(data);
    EXPECT_LT(glm::distance(data.instances.at(0).world_from_local[3], glm::vec3(0, -9, 0)), 1e-5F);
    EXPECT_LT(glm::distance(data.instances.at(0).world_from_local[0], glm::vec3(1, 0, 0)), 1e-5F);
}

}  // namespace
}  // namespace gazeloop::tests
