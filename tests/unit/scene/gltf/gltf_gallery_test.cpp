// A scene of the size that the program is meant for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/support/recorded_data.h"
#include "tests/unit/scene/gltf/loaded.h"

namespace gazeloop::tests {
namespace {

using testing::HasSubstr;

TEST(GltfGallery, HoldsWhatItsMakerSays) {
    const std::string name = "scenes/gallery/gallery.gltf";
    if (const std::string missing = no_recorded_data(name); !missing.empty()) {
        GTEST_SKIP() << missing;
    }
    const std::filesystem::path file = recorded_data(name);
    const auto scene = scene::gltf::load_gltf(file);
    ASSERT_TRUE(scene) << scene.error().message;
    const auto& data = scene->data;
    std::uint64_t unique = 0;
    for (std::size_t i = 0; i < data.levels.size(); ++i) {
        unique += data.levels[i].error_m == 0.0F
                      ? data.primitives[data.levels[i].primitive].index_count / 3
                      : 0;
    }
    std::uint64_t instanced = 0;
    for (const auto& instance : data.instances) {
        instanced += data.primitives[data.levels[instance.first_level].primitive].index_count / 3;
    }
    EXPECT_EQ(unique, 273570U);
    EXPECT_EQ(instanced, 747180U);
    EXPECT_EQ(data.materials.size(), 9U);
    EXPECT_EQ(data.images.size(), 22U);
    EXPECT_THAT(notes_of(*scene), HasSubstr("KHR_materials_clearcoat is not supported"));
    EXPECT_EQ(scene->notes.size(), 1U) << notes_of(*scene);
}

}  // namespace
}  // namespace gazeloop::tests
