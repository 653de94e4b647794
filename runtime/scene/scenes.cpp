#include "runtime/scene/scenes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "runtime/error.h"
#include "runtime/scene/ray_scene.h"
#include "shaders/shader_library.h"

namespace gazeloop::scene {

std::span<const std::string_view> scene_names() { return shaders::scenes(); }

std::unique_ptr<Scene> make_scene(const vulkan::Context& /*context*/, std::string_view name) {
    const auto names = scene_names();
    if (std::ranges::find(names, name) == names.end()) {
        throw SetupError(ErrorKind::Usage, fmt::format("there is no scene '{}': there are {}", name,
                                                       fmt::join(names, ", ")));
    }
    return std::make_unique<RayScene>(name);
}

}  // namespace gazeloop::scene
