// A scene from a file, drawn: what the file says is where the picture shows it.
#include <gtest/gtest.h>

#include <fstream>

#include "runtime/error.h"
#include "tests/support/encoded_pictures.h"
#include "tests/support/frame_renderer_fixture.h"
#include "tests/support/gltf_file.h"
#include "tests/support/temporary_folder.h"

namespace gazeloop::render {
namespace {

class SceneFileTest : public FrameRendererTest {
  protected:
    static Picture picture_of(const std::filesystem::path& file, Method method) {
        const auto scene = scene::make_scene(context(), file.string());
        const MethodConfig of = config(method, 96, 72);
        OffScreen off_screen(context(), *scene, passes_of(of), of);
        const FrameRequest asked = request(of, {48.0, 36.0});
        off_screen.render(asked.frame_view(), asked.fovea());
        return off_screen.picture(gaze::Eye::Left);
    }
};

/// A square of one unlit texture: red above, blue below. Its viewer stands half a metre before it.
tests::GltfFile two_colors() {
    tests::GltfFile file;
    const std::vector<std::uint8_t> pixels{255, 0, 0, 255, 0, 0, 255, 255};
    const std::size_t view =
        file.add_view_of(tests::encoded_png(1, 2, PNG_FORMAT_RGBA, pixels.data()));
    const nlohmann::json attributes{
        {"POSITION", file.add_positions<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0})},
        {"TEXCOORD_0", file.add_accessor<float>("VEC2", {0, 1, 1, 1, 0, 0, 1, 0})}};
    file.document["meshes"] = {
        {{"primitives", {{{"attributes", attributes}, {"mode", 5}, {"material", 0}}}}}};
    file.document["images"] = {{{"bufferView", view}}};
    file.document["textures"] = {{{"source", 0}, {"sampler", 0}}};
    file.document["samplers"] = {{{"magFilter", 9728}, {"wrapS", 33071}, {"wrapT", 33071}}};
    file.document["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
         {"extensions", {{"KHR_materials_unlit", nlohmann::json::object()}}}}};
    file.document["extensionsUsed"] = {"KHR_materials_unlit"};
    file.document["nodes"] = {{{"mesh", 0}, {"translation", {7, 8, 9}}}};
    file.document["scenes"] = {{{"nodes", {0}}}};
    return file;
}

TEST_F(SceneFileTest, ShowsTexturesTheRightWayUpByEveryMethod) {
    const tests::TemporaryFolder folder;
    const auto bytes = two_colors().glb();
    std::ofstream(folder / "a.glb", std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    for (const Method method : {Method::Full, Method::Kfr}) {
        const Picture seen = picture_of(folder / "a.glb", method);
        const auto at = [&](std::size_t x, std::size_t y) {
            return seen.pixels[y * seen.width + x];
        };
        const auto above = at(48, 26);
        EXPECT_GT(above[0], 250);
        EXPECT_LT(above[2], 5);
        const auto below = at(48, 46);
        EXPECT_LT(below[0], 5);
        EXPECT_GT(below[2], 250);
    }
}

TEST_F(SceneFileTest, ThatIsBrokenIsBadInput) {
    try {
        (void)scene::make_scene(context(), "/nowhere/a.gltf");
        FAIL();
    } catch (const SetupError& error) {
        EXPECT_EQ(error.kind(), ErrorKind::BadInput);
    }
}

}  // namespace
}  // namespace gazeloop::render
