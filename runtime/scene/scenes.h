#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "runtime/scene/scene.h"

namespace gazeloop::scene {

/// Names of the scenes that come with the program.
[[nodiscard]] std::span<const std::string_view> scene_names();

struct SceneOptions {
    /// Draw and light as if the scene needed everything, to measure what leaving out saves.
    bool require_all = false;
};

/// A scene by its name. Throws SetupError (Usage) for one that there is not.
[[nodiscard]] std::unique_ptr<Scene> make_scene(const vulkan::Context& context,
                                                std::string_view name,
                                                const SceneOptions& options = {});

}  // namespace gazeloop::scene
