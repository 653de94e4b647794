#include "runtime/scene/scenes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "runtime/error.h"
#include "runtime/scene/gallery/gallery_scene.h"
#include "runtime/scene/light_field_file.h"
#include "runtime/scene/light_field_scene.h"
#include "runtime/scene/mesh_scene.h"
#include "runtime/scene/ray_scene.h"
#include "runtime/scene/scene_file.h"
#include "shaders/shader_library.h"

namespace gazeloop::scene {
namespace {

constexpr std::string_view kGallery = "gallery";

/// Those of shaders/scenes that are scenes by themselves, and those that are made of meshes. Light
/// fields are files.
std::vector<std::string_view> all_names() {
    std::vector<std::string_view> names{kGallery};
    std::ranges::copy_if(shaders::scenes(), std::back_inserter(names), [](std::string_view name) {
        return name != kMeshShader && name != kLightFieldShader;
    });
    std::ranges::sort(names);
    return names;
}

}  // namespace

std::span<const std::string_view> scene_names() {
    static const std::vector<std::string_view> kNames = all_names();
    return kNames;
}

bool is_of_meshes(std::string_view scene) { return scene == kGallery || is_scene_file(scene); }

bool is_light_field(std::string_view scene) {
    return scene == kBakedLightField || is_light_field_file(scene);
}

std::unique_ptr<Scene> make_scene(const vulkan::Context& context, std::string_view name,
                                  const SceneOptions& options) {
    if (is_scene_file(name)) {
        return make_mesh_scene(context, load_scene_file(name), options);
    }
    if (is_light_field_file(name)) {
        const LightFieldSettings& set = options.light_field;
        light_field::Lens lens = set.lens();
        lens.every_view = options.require_all;
        return make_light_field_scene(context, value_or_throw(open_light_field(name)), lens,
                                      set.memory());
    }
    const auto names = scene_names();
    if (std::ranges::find(names, name) == names.end()) {
        throw SetupError(ErrorKind::Usage,
                         fmt::format("there is no scene '{}': there are {}, and any "
                                     ".gltf or .glb file by its name",
                                     name, fmt::join(names, ", ")));
    }
    if (name == kGallery) {
        return make_mesh_scene(context, gallery::gallery_scene(), options);
    }
    return std::make_unique<RayScene>(name, options.footprint);
}

}  // namespace gazeloop::scene
