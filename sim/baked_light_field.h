#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string_view>

#include "runtime/error.h"
#include "runtime/scene/scenes.h"
#include "sim/light_field_baker.h"

namespace gazeloop::sim {

/// The light field of kBakedLightField: of raymarch, from cameras over what both eyes of a still
/// head look through. 225 MiB of the GPU's memory.
inline constexpr LightFieldBake kBuiltInBake{
    .views = 15, .size_px = 512, .spacing_m = 0.005, .field_deg = 100.0};

/// The file of a light field of raymarch below `cache`, baked the first time: again where the scene
/// or the bake is another one. Half of one is never found there. `go_on` false: it ends
/// (Interrupted). Errors: as bake_light_field; (BadInput) a cache that cannot be written, a folder
/// of that name without the file.
Expected<std::filesystem::path> baked_light_field(const vulkan::Context& context,
                                                  const LightFieldBake& bake,
                                                  const std::filesystem::path& cache,
                                                  const std::function<bool()>& go_on);

/// As scene::make_scene, and kBakedLightField by its name, baked into the user's cache the first
/// time. Throws SetupError: as scene::make_scene and baked_light_field.
[[nodiscard]] std::unique_ptr<scene::Scene> make_scene(const vulkan::Context& context,
                                                       std::string_view name,
                                                       const scene::SceneOptions& options,
                                                       const std::function<bool()>& go_on);

}  // namespace gazeloop::sim
