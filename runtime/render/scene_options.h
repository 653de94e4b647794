#pragma once

#include "runtime/render/render_settings.h"
#include "runtime/scene/scenes.h"

namespace gazeloop::render {

/// How the settings want a scene to be made.
[[nodiscard]] scene::SceneOptions scene_options(const RenderSettings& render,
                                                const scene::LightFieldSettings& light_field);

}  // namespace gazeloop::render
