#pragma once

#include <memory>
#include <string_view>

#include "runtime/light_field/lens.h"
#include "runtime/scene/light_field_file.h"
#include "runtime/scene/scene.h"

namespace gazeloop::scene {

/// The shader of light fields: no scene by itself.
inline constexpr std::string_view kLightFieldShader = "lightfield";

/// A light field seen through a lens; nothing moves in it. Throws SetupError: views that the device
/// cannot hold as one image (BadInput), no memory (NoDevice).
[[nodiscard]] std::unique_ptr<Scene> make_light_field_scene(const vulkan::Context& context,
                                                            LightFieldPictures pictures,
                                                            const light_field::Lens& lens);

}  // namespace gazeloop::scene
