#include "runtime/scene/scene_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <fstream>
#include <sstream>

#include "runtime/error.h"
#include "tests/support/gltf_file.h"
#include "tests/support/temporary_folder.h"

namespace gazeloop::tests {
namespace {

using testing::HasSubstr;

TEST(SceneFiles, AreKnownByTheirNames) {
    EXPECT_TRUE(scene::is_scene_file("a.gltf"));
    EXPECT_TRUE(scene::is_scene_file("folder/a.glb"));
    for (const char* name : {"gallery", "", ".gltf", "a.gltf.txt", "gltf", "a.GLB"}) {
        EXPECT_FALSE(scene::is_scene_file(name)) << name;
    }
}

TEST(SceneFiles, LogWhatTheyHoldAndWhatIsNotShown) {
    const TemporaryFolder folder;
    GltfFile file = one_triangle();
    file.document["extensionsUsed"] = {"KHR_materials_clearcoat"};
    const auto bytes = file.glb();
    std::ofstream(folder / "a.glb", std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    std::ostringstream text;
    const auto before = spdlog::default_logger();
    spdlog::set_default_logger(std::make_shared<spdlog::logger>(
        "test", std::make_shared<spdlog::sinks::ostream_sink_mt>(text)));
    const auto data = scene::load_scene_file(folder / "a.glb");
    spdlog::set_default_logger(before);
    EXPECT_EQ(data.instances.size(), 1U);
    EXPECT_THAT(text.str(), HasSubstr("a.glb: 1 triangles in 1 instances, 0 pictures, loaded in"));
    EXPECT_THAT(text.str(), HasSubstr("KHR_materials_clearcoat is not supported"));
}

TEST(SceneFiles, BadOnesThrow) {
    try {
        (void)scene::load_scene_file("/nowhere/a.glb");
        FAIL();
    } catch (const SetupError& error) {
        EXPECT_EQ(error.kind(), ErrorKind::BadInput);
        EXPECT_THAT(error.what(), HasSubstr("/nowhere/a.glb"));
    }
}

}  // namespace
}  // namespace gazeloop::tests
