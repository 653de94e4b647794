#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "runtime/scene/light_field_settings.h"
#include "runtime/scene/scene.h"

namespace gazeloop::scene {

/// Names of the scenes that come with the program and need no rendering before they are shown.
[[nodiscard]] std::span<const std::string_view> scene_names();

/// One that does: a light field, which is rendered once and kept (sim::make_scene).
inline constexpr std::string_view kBakedLightField = "lightfield";

/// Whether a scene, by its name or file, is drawn from meshes.
[[nodiscard]] bool is_of_meshes(std::string_view scene);

/// Whether a scene, by its name or file, is a light field.
[[nodiscard]] bool is_light_field(std::string_view scene);

struct SceneOptions {
    /// Draw and light as if the scene needed everything, to measure what leaving out saves.
    bool require_all = false;
    /// Highlights of meshes are as wide as normals turn within a pixel.
    bool specular_filter = true;
    /// Detail that is finer than the samples lie apart fades: highlights of meshes, the floor of
    /// raymarch.
    bool footprint = false;
    LightFieldSettings light_field{};

    friend bool operator==(const SceneOptions&, const SceneOptions&) = default;
};

/// A scene by its name, or of a file (scene_file.h, light_field_file.h). Throws SetupError: Usage
/// for a name that there is not, BadInput for a file that cannot be used.
[[nodiscard]] std::unique_ptr<Scene> make_scene(const vulkan::Context& context,
                                                std::string_view name,
                                                const SceneOptions& options = {});

}  // namespace gazeloop::scene
