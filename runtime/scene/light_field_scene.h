#pragma once

#include <memory>
#include <string_view>

#include "runtime/light_field/lens.h"
#include "runtime/scene/light_field_file.h"
#include "runtime/scene/light_field_views.h"
#include "runtime/scene/scene.h"

namespace gazeloop::scene {

/// The shader of light fields: no scene by itself.
inline constexpr std::string_view kLightFieldShader = "lightfield";

/// A light field seen through a lens; nothing moves in it. Where its views do not fit into memory,
/// its frames wait for those they are made of: between the begin and the finish of one renderer's
/// frame, no other renderer of the scene may begin one. Throws SetupError: as LightFieldViews.
[[nodiscard]] std::unique_ptr<Scene> make_light_field_scene(const vulkan::Context& context,
                                                            const LightFieldSource& source,
                                                            const light_field::Lens& lens,
                                                            const LightFieldMemory& memory = {});

}  // namespace gazeloop::scene
